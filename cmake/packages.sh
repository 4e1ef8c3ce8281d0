# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# The Debian packages that this project needs and functions to install them, for the run scripts:
#   source cmake/packages.sh
#   smg_install "${smg_build_packages[@]}"
# NAME|OTHER|...: the first of these that exists in the release.

smg_build_packages=(
  build-essential cmake ninja-build pkg-config ccache
  libeigen3-dev libsuitesparse-dev libzstd-dev liblz4-dev libxxhash-dev zlib1g-dev
  liblzma-dev libhdf5-dev
  nlohmann-json3-dev libcli11-dev libfast-float-dev)
# paraview-dev needs python3-paraview, libopenmpi-dev and libpython3-dev without declaring it; see also
# smg_install.
smg_paraview_packages=(
  paraview paraview-dev python3-paraview libopenmpi-dev libpython3-dev xvfb xauth
  "qt6-svg-plugins|libqt5svg5"
  qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools) # the help of the plugin, with Qt 5
smg_test_packages=(
  libgtest-dev libbenchmark-dev libmeshoptimizer-dev lld clang-format doxygen openmpi-bin libopenmpi-dev libhypre-dev
  xz-utils gmsh calculix-ccx
  python3 python3-jsonschema python3-numpy python3-scipy python3-getfem python3-matplotlib python3-meshio python3-pip
  python3-venv python3-tqdm mypy)
smg_benchmark_packages=(
  libbenchmark-dev libhypre-dev libmeshoptimizer-dev libpetsc-real-dev libopenmpi-dev
  python3 python3-matplotlib python3-scipy)
smg_verification_packages=(
  libbenchmark-dev libhypre-dev libopenmpi-dev
  python3 python3-numpy python3-scipy python3-getfem python3-matplotlib)
smg_fuzzing_packages=(clang "libclang-rt-14-dev|libclang-rt-dev")

# As root: directly, or through sudo.
smg_as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    echo "These packages are missing and this user may not install them: run as root: $*" >&2
    return 1
  fi
}

# smg_is_installed PACKAGE
smg_is_installed() {
  # One status per architecture.
  [[ " $(dpkg-query -W -f='${db:Status-Status} ' "$1" 2> /dev/null)" == *" installed "* ]]
}

# smg_fetch_lists : updates the package lists
smg_fetch_lists() {
  echo "Fetching the lists of packages"
  smg_as_root apt-get update -qq
}

# smg_choose NAME|OTHER|... : prints the first one that is in the lists of apt or installed.
smg_choose() {
  local package names
  IFS='|' read -r -a names <<< "$1"
  for package in "${names[@]}"; do
    if [ ${#names[@]} -eq 1 ] || apt-cache show "$package" > /dev/null 2>&1; then
      echo "$package"
      return
    fi
  done
  echo "${names[0]}"
}

# smg_say_so COMMAND... : prints the output of the command, and a line every few seconds without
# output.
smg_say_so() {
  local start=$SECONDS line begun= status
  "$@" 2>&1 | while :; do
    status=0
    IFS= read -r -t 5 line || status=$?
    begun+=$line
    if [ "$status" -gt 128 ]; then
      echo "... $((SECONDS - start)) s"
    else
      [ "$status" != 0 ] && [ -z "$begun" ] || echo "$begun"
      begun=
      [ "$status" = 0 ] || break
    fi
  done
  return "${PIPESTATUS[0]}"
}

# Shortens the output of apt and dpkg to every twentieth package and errors.
smg_shorten() {
  awk '/^(Unpacking|Setting up) / { if (++n % 20 == 0) { print n " steps: " $0; fflush() } }
       /^(E:|W:|dpkg: error)/ || /^Need to get / || / newly installed/ { print; fflush() }'
}

# smg_install PACKAGE... : installs missing packages; never removes one. If none is missing, neither apt
# nor the network is used.
smg_install() {
  local names needs package missing
  local lists_are_new=
  while :; do
    missing=() names=("$@")
    # paraview-dev does not declare the headers of ParaView's Qt, nor those of VTK if ParaView uses that
    # of the release.
    if [[ " $* " == *" paraview-dev "* ]]; then
      needs=$(apt-cache depends paraview 2> /dev/null || true)
      [[ $needs == *"Depends: libqt6"* ]] && names+=(qt6-base-dev) || names+=(qtbase5-dev)
      [[ $needs != *"Depends: libvtk"* ]] || names+=(libvtk9-dev)
    fi
    for package in "${names[@]}"; do
      package=$(smg_choose "$package")
      smg_is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    # Package lists may be absent or outdated: update them and try once more.
    if [ -n "$lists_are_new" ] || apt-cache show "${missing[@]}" > /dev/null 2>&1; then
      echo "Installing: ${missing[*]}"
      smg_as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends --no-remove "${missing[@]}" |
        smg_say_so smg_shorten && return 0
      [ -z "$lists_are_new" ] || return 1
    fi
    smg_fetch_lists || true
    lists_are_new=1
  done
}
