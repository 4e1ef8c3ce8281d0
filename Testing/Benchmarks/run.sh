#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Benchmarks/run.sh [MESH...] : measures the solver beside hypre and CHOLMOD and leaves a
# table and the numbers of each mesh in build-benchmarks/results. Without arguments it makes its own
# meshes: tori of 0.25 and 1 million vertices and a box of tetrahedra of 0.25 million. A MESH may
# have any format that `smg convert` reads.
#
# To repeat a measurement: keep the machine otherwise idle, and run it twice; the spread between the
# runs is the accuracy of the times.
set -euo pipefail
meshes=()
for mesh in "$@"; do
  meshes+=("$(realpath "$mesh")")
done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_benchmark_packages[@]}"

launcher=()
! command -v ccache > /dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake --preset benchmarks "${launcher[@]}" > /dev/null
cmake --build --preset benchmarks
bin=$PWD/build-benchmarks/bin
results=$PWD/build-benchmarks/results
mkdir -p "$results"

# measure MESH.vsm
measure() {
  local name
  name=$(basename "$1" .vsm)
  "$bin/benchmark_peers" "$1" --json "$results/$name.json" | tee "$results/$name.md"
}

if [ ${#meshes[@]} -eq 0 ]; then
  for sizes in "torus 250000" "torus 1000000" "box 250000"; do
    mesh=$results/${sizes/ /-}.vsm
    # shellcheck disable=SC2086
    "$bin/make_mesh" $sizes "$mesh"
    measure "$mesh"
  done
else
  for mesh in "${meshes[@]}"; do
    name=$(basename "$mesh")
    "$bin/smg" convert "$mesh" "$results/${name%.*}.vsm"
    measure "$results/${name%.*}.vsm"
  done
fi
echo "The tables and numbers are in $results"
