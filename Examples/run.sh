#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the ParaView plugin on a Debian 12 or 13 machine (as root, or as a user with sudo) and
# deforms the Stanford bunny out of core with pvpython; then builds the rest: the program smg and
# all lessons. Leaves in Examples/output: bunny-deformed.png (before and after), .vsm and .ply (the
# deformed mesh), .json (the report).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_paraview_packages[@]}"

# A configured build folder, for instance of Testing/run.sh, is only updated. Otherwise the first
# build omits parts that the picture does not need: the second build of the solver, and Python.
rest=(-DSMG_BUILD_X86_64_V3=ON -DSMG_BUILD_PYTHON=ON)
unfinished=build/without-the-rest
if [ ! -e build/build.ninja ]; then
  mkdir -p build
  touch "$unfinished"
  smg_say_so cmake --preset examples "${rest[@]/%ON/OFF}"
fi
smg_say_so cmake --build build --target StreamingMultigrid

mkdir -p Examples/output
plugin=$(find "$PWD/build" -name StreamingMultigrid.so | head -n 1)
smg_say_so xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython \
  Examples/Deformation/pvpython/deformation.py --plugin "$plugin" --output Examples/output
echo "The picture, after $SECONDS s: $PWD/Examples/output/bunny-deformed.png"
echo "The mesh:    $PWD/Examples/output/bunny-deformed.vsm and .ply"
echo "The report:  $PWD/Examples/output/bunny-deformed.json"

if [ -e "$unfinished" ]; then
  echo "Building the rest: the program smg, the lessons, the Python package"
  smg_say_so cmake -S . -B build "${rest[@]}"
  rm "$unfinished"
fi
smg_say_so cmake --build build
echo "The program: $PWD/build/bin/smg"
