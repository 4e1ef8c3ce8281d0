#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Benchmarks/run.sh [MESH...] : measures the solver beside hypre and CHOLMOD, and the
# interactive deformation of each mesh's preview, and leaves a table and the numbers of each mesh in
# build-benchmarks/results. Without arguments it makes its own meshes: tori of 0.25 and 1 million
# vertices, a box of tetrahedra of 0.25 million, and a bumpy surface like a scan of 1 million, of
# which the preview alone is measured. A MESH may have any format that `smg convert` reads.
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

# measure_preview MESH.vsm
measure_preview() {
  "$bin/benchmark_interactive" "$1" --benchmark_counters_tabular=true \
    --benchmark_out="$results/$(basename "$1" .vsm)-interactive.json"
}

# measure MESH.vsm
measure() {
  local name
  name=$(basename "$1" .vsm)
  "$bin/benchmark_peers" "$1" --json "$results/$name.json" | tee "$results/$name.md"
  measure_preview "$1"
}

# made SHAPE VERTICES : makes the mesh and prints its name
made() {
  "$bin/make_mesh" "$1" "$2" "$results/$1-$2.vsm" >&2
  echo "$results/$1-$2.vsm"
}

if [ ${#meshes[@]} -eq 0 ]; then
  measure "$(made torus 250000)"
  measure "$(made torus 1000000)"
  measure "$(made box 250000)"
  measure_preview "$(made scan 1000000)"
else
  for mesh in "${meshes[@]}"; do
    name=$(basename "$mesh")
    "$bin/smg" convert "$mesh" "$results/${name%.*}.vsm"
    measure "$results/${name%.*}.vsm"
  done
fi
echo "The tables and numbers are in $results"
