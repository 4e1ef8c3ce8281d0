#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Benchmarks/run.sh [MESH...] : measures the solver beside hypre and CHOLMOD, and the
# interactive deformation of each mesh's preview, and leaves a table and the numbers of each mesh in
# build-benchmarks/results. Without arguments it makes its own meshes: tori of 0.25 and 1 million
# vertices, a box of tetrahedra of 0.25 million, and a bumpy surface like a scan of 1 million, of
# which the preview alone is measured. A MESH may have any format that `smg convert` reads.
#
# Testing/Benchmarks/run.sh convert [OPTION VALUE]... [MESH...] : measures the conversion of each
# mesh, and what VTK's reader takes where ParaView is installed. Its options are
#   --memory 64,256                  limits of the memory in MiB
#   --orders bfs,spectral,axis,keep  which orders
#   --address-space MiB              as ulimit -v on every conversion, to prove the memory; the
#                                    program itself and the stacks of its threads count
# Without a MESH it makes its own, refined and shuffled: a torus of 1 million vertices and a box of
# tetrahedra of 0.5 million. A larger real one is made by
#   build-benchmarks/bin/make_mesh finer dragon.ply 3 dragon-x64.ply --shuffle
# Scratch files go to TMPDIR, which should be a disk.
#
# To repeat a measurement: keep the machine otherwise idle, and run it twice; the spread between the
# runs is the accuracy of the times.
set -euo pipefail
part=solve
if [ "${1:-}" = convert ]; then
  part=convert
  shift
fi
meshes=()
options=()
while [ $# -gt 0 ]; do
  case "$part$1" in
    convert--memory | convert--orders | convert--address-space)
      options+=("$1" "${2:?"$1 needs a value"}")
      shift
      ;;
    *) meshes+=("$(realpath -e "$1")") ;;
  esac
  shift
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

# measure_conversion MESH
measure_conversion() {
  local name out
  name=$(basename "$1")
  out=$results/${name%.*}-convert
  "$bin/benchmark_convert" "$1" "${options[@]}" --json "$out.json" | tee "$out.md"
  # Debian's Python, which is the one that ParaView's modules are for. Its reader may fail.
  if [[ $1 == *.@(ply|vtk) ]] && /usr/bin/python3 -c "import vtkmodules" 2> /dev/null; then
    /usr/bin/python3 Testing/Benchmarks/read_with_vtk.py "$1" "$out-vtk.json" | tee -a "$out.md" ||
      echo "VTK does not read $1" | tee -a "$out.md"
  fi
}

# made SHAPE VERTICES : makes the mesh and prints its name
made() {
  "$bin/make_mesh" "$1" "$2" "$results/$1-$2.vsm" >&2
  echo "$results/$1-$2.vsm"
}

# made_finer SHAPE VERTICES SUFFIX : makes the mesh, refines it once, shuffles it, prints its name
made_finer() {
  "$bin/make_mesh" "$1" "$2" "$results/$1-$2.$3" >&2
  "$bin/make_mesh" finer "$results/$1-$2.$3" 1 "$results/$1-$2-finer.$3" --shuffle >&2
  echo "$results/$1-$2-finer.$3"
}

convert_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    meshes=("$(made_finer torus 250000 ply)" "$(made_finer box 64000 vtk)")
  fi
  for mesh in "${meshes[@]}"; do
    measure_conversion "$mesh"
  done
}

solve_part() {
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
}

"${part}_part"
echo "The tables and numbers are in $results"
