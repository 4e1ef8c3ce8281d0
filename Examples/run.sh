#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds libraries, ParaView plugin and the program smg on a Debian 12 machine (as root, or as a user
# with sudo) and lets pvpython compute and draw a harmonic field on the Stanford bunny, out of core.
# Leaves bunny-harmonic.png and the solver's report, bunny-harmonic.json, in Examples/output.
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
xvfb-run -a pvpython Examples/HarmonicField/pvpython/harmonic_field.py \
  --plugin "$plugin" --output Examples/output
echo "The picture: $PWD/Examples/output/bunny-harmonic.png"
echo "The report:  $PWD/Examples/output/bunny-harmonic.json"
