# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# The Debian 12 packages that this project needs, and their installation; for the run scripts:
#   source cmake/packages.sh
#   smg_install "${smg_build_packages[@]}"

smg_build_packages=(
  build-essential cmake ninja-build pkg-config ccache
  libeigen3-dev libsuitesparse-dev libtbb-dev libzstd-dev liblz4-dev libxxhash-dev zlib1g-dev
  nlohmann-json3-dev libcli11-dev libfast-float-dev)
# python3-paraview and libopenmpi-dev are needed by paraview-dev, which does not say so.
smg_paraview_packages=(
  paraview paraview-dev python3-paraview libopenmpi-dev xvfb xauth libqt5svg5)
smg_test_packages=(
  libgtest-dev clang-format openmpi-bin xz-utils
  python3 python3-jsonschema python3-numpy python3-scipy python3-getfem)
smg_benchmark_packages=(
  libbenchmark-dev libhypre-dev libpetsc-real-dev libopenmpi-dev python3 python3-matplotlib)
smg_verification_packages=(
  libbenchmark-dev libhypre-dev libopenmpi-dev
  python3 python3-numpy python3-scipy python3-getfem python3-matplotlib)
smg_fuzzing_packages=(clang libclang-rt-14-dev)

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

# smg_install PACKAGE... : installs the ones that are missing; never removes one. Without a missing
# one nothing is asked of apt or the network.
smg_install() {
  local package missing=()
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null)" = installed ] ||
      missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "Installing: ${missing[*]}"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get)
  local install=("${apt[@]}" install -y --no-install-recommends --no-remove "${missing[@]}")
  # Package lists may be absent or out of date: then they are fetched, and it is tried once more.
  smg_as_root "${install[@]}" > /dev/null 2>&1 && return 0
  smg_as_root "${apt[@]}" update || true
  smg_as_root "${install[@]}"
}
