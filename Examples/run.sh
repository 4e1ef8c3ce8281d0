#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds libraries, ParaView plugin and the program smg on a Debian 12 machine (as root, or as a user
# with sudo) and lets pvpython deform the Stanford bunny, out of core. Leaves in Examples/output:
# bunny-deformed.png (before and after), .vsm and .ply (the deformed mesh), .json (the report).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_paraview_packages[@]}"

# A tree that is configured already, for instance by Testing/run.sh, is only brought up to date.
if [ ! -e build/build.ninja ]; then
  launcher=()
  ! command -v ccache > /dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake --preset examples "${launcher[@]}"
fi
cmake --build build

mkdir -p Examples/output
plugin=$(find "$PWD/build" -name StreamingMultigrid.so | head -n 1)
xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython Examples/Deformation/pvpython/deformation.py \
  --plugin "$plugin" --output Examples/output
echo "The picture: $PWD/Examples/output/bunny-deformed.png"
echo "The mesh:    $PWD/Examples/output/bunny-deformed.vsm and .ply"
echo "The report:  $PWD/Examples/output/bunny-deformed.json"
