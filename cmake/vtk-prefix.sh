#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# vtk-prefix.sh PREFIX : creates a private development prefix of Debian's standalone VTK.
# apt installs its runtime libraries; the development packages conflict with those of ParaView and are
# therefore unpacked in PREFIX. Does nothing if PREFIX is complete.
set -euo pipefail
prefix=$(realpath -m "${1:?usage: vtk-prefix.sh PREFIX}")
source "$(dirname "${BASH_SOURCE[0]}")/packages.sh"

# The name of the runtime package contains the version: libvtk9.1, libvtk9.3.
runtime_of() { apt-cache depends libvtk9-dev 2> /dev/null | grep -oE '\blibvtk9\.[0-9]+[a-z0-9]*$' | head -n 1; }
runtime=$(runtime_of) || { smg_fetch_lists && runtime=$(runtime_of); } || true
[ -n "$runtime" ] || {
  echo "apt knows no libvtk9-dev: is Debian's main archive among its sources?" >&2
  exit 1
}
smg_install "$runtime" libtbb-dev libopenmpi-dev
if [ -e "$prefix/complete" ]; then
  exit 0
fi

downloads=$(mktemp -d)
trap 'rm -rf "$downloads"' EXIT
cd "$downloads"
options=()
[ "$(id -u)" != 0 ] || options=(-o APT::Sandbox::User=root)
packages=(libvtk9-dev vtk9 python3-vtk9)
apt-get "${options[@]}" download "${packages[@]}" || {
  smg_fetch_lists
  apt-get "${options[@]}" download "${packages[@]}"
}
mkdir -p "$prefix"
for package in ./*.deb; do
  dpkg -x "$package" "$prefix"
done

# The development links and the class hierarchies refer to files of the runtime package.
machine=$(gcc -print-multiarch)
for library in /usr/lib/"$machine"/libvtk*-9.*.so.*; do
  ln -sf "$library" "$prefix/usr/lib/$machine/"
done
for folder in /usr/lib/"$machine"/vtk /usr/lib/"$machine"/vtk-9.*; do
  [ ! -d "$folder/hierarchy" ] || ln -sfn "$folder" "$prefix/usr/lib/$machine/"
done
touch "$prefix/complete"
echo "VTK: -DVTK_ROOT=$prefix/usr"
