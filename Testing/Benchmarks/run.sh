#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Benchmarks/run.sh [PART] [OPTION VALUE]... [MESH...] : measures, and writes tables (.md) and
# numbers (.json) to build-benchmarks/results. A MESH may have any format that `smg convert` reads,
# a .vsm is used unchanged; without one a part generates its own. The parts:
#
#   solve     (default) the solver, hypre, PETSc and CHOLMOD, and the interactive deformation of
#             each mesh's preview. Its own meshes: tori of 0.25 and 1 million vertices, a box of
#             tetrahedra of 0.25 million, and a bumpy surface like a scan of 1 million, where
#             only the preview is measured.
#   convert   the conversion of each mesh, and the cost of VTK's reader if ParaView is installed.
#               --memory 64,256                  memory limits in MiB
#               --orders bfs,spectral,axis,keep  which orders
#               --address-space MiB              as ulimit -v on every conversion, to prove the
#                                                memory; the program itself and the stacks of its
#                                                threads count
#             Its own meshes, refined and shuffled: a torus of 1 million vertices and a box of
#             tetrahedra of 0.5 million. To make a larger real one:
#               build-benchmarks/bin/make_mesh finer dragon.ply 3 dragon-x64.ply --shuffle
#   scaling   the growth of memory and time: each mesh is refined repeatedly, converted and
#             solved out of core with one and two threads; scaling.md, .json and .svg, with the
#             exponents of the growth.
#               --to VERTICES        most vertices of a mesh (3000000)
#               --peers-to VERTICES  most vertices of a mesh for the other solvers (1000000)
#             Its own meshes: a torus and a box of tetrahedra of 40 thousand vertices. The results
#             shown in the README are in Testing/Benchmarks/results.
#   table3    Table 3 of the paper for these meshes: I/O, hierarchy, multigrid, total time, peak nodes
#             and memory, out of core and in core; table3.md and .json. Meshes as for solve.
#               --threads N          of each solve (1)
#   kernels   nanoseconds per node of each kernel. Its own mesh: a torus of 0.25 million vertices.
#   convergence  V-cycles with and without acceleration, the factors of a V-cycle and of two levels
#             alone, by level, and at which vertices the slowest error sits. Its own meshes: a torus
#             and a box of tetrahedra of 0.25 million vertices.
#   schedule  how much faster a solve becomes with more threads: a model from the times of its stages
#             on one thread, for 1 to 64 threads. Its own meshes: a torus of 1 million vertices, and a
#             box of tetrahedra of 0.25 million. Beside it, wall times with the cores of this machine.
#   roofline  the bytes that a pass moves, compared with the bandwidths of memory, page
#             cache and disk. Its own mesh: a torus of 1 million vertices.
#               --scratch DIR        on the disk to measure (TMPDIR)
#               --threads 1,2        of the solves
#               --file MiB           size of the measured file (1024)
#   story     what people do with one large scan, all with the same memory limit: convert, smooth,
#             distances from a point, a picture with isolines; story.md, .json and .png. MESH is
#             refined and gets noise; without one it is a torus of 40 thousand vertices.
#               --times N            refinements, each with four times the vertices (3)
#               --memory MiB         limit of every step (128)
#               --size S             of smg smooth (8edges)
#               --source WHERE       of smg distance ({"vertices": [0]})
#               --plugin FILE        StreamingMultigrid.so, for the picture
#
# Scratch files go to TMPDIR, which should be a disk. To repeat a measurement: keep the machine
# otherwise idle, and run it twice; the spread between the runs is the accuracy of the times.
set -euo pipefail
part=solve
case "${1:-}" in
  solve | convert | scaling | table3 | kernels | convergence | schedule | roofline | story)
    part=$1
    shift
    ;;
esac
meshes=()
options=()
while [ $# -gt 0 ]; do
  case "$part$1" in
    convert--memory | convert--orders | convert--address-space | scaling--to | scaling--peers-to | \
      table3--threads | roofline--scratch | roofline--threads | roofline--file | story--times | \
      story--memory | story--size | story--source | story--plugin)
      options+=("$1" "${2:?"$1 needs a value"}")
      shift
      ;;
    *) meshes+=("$(realpath -e -- "$1")") ;;
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
  # Debian's Python, for which ParaView's modules are built. Its reader may fail.
  if [[ $1 == *.@(ply|vtk) ]] && /usr/bin/python3 -c "import vtkmodules" 2> /dev/null; then
    /usr/bin/python3 Testing/Benchmarks/read_with_vtk.py "$1" "$out-vtk.json" | tee -a "$out.md" ||
      echo "VTK does not read $1" | tee -a "$out.md"
  fi
}

# made SHAPE VERTICES [SUFFIX] : makes the mesh, a stream unless SUFFIX says else, prints its name
made() {
  "$bin/make_mesh" "$1" "$2" "$results/$1-$2.${3:-vsm}" >&2
  echo "$results/$1-$2.${3:-vsm}"
}

# made_finer SHAPE VERTICES SUFFIX : makes the mesh, refines it once, shuffles it, prints its name
made_finer() {
  local mesh finer
  mesh=$(made "$@")
  finer=${mesh%."$3"}-finer.$3
  "$bin/make_mesh" finer "$mesh" 1 "$finer" --shuffle >&2
  echo "$finer"
}

# Converts those meshes that are not streams.
convert_meshes() {
  local i name
  for i in "${!meshes[@]}"; do
    if [[ ${meshes[i]} != *.vsm ]]; then
      name=$(basename "${meshes[i]}")
      "$bin/smg" convert "${meshes[i]}" "$results/${name%.*}.vsm"
      meshes[i]=$results/${name%.*}.vsm
    fi
  done
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
    convert_meshes
    for mesh in "${meshes[@]}"; do
      measure "$mesh"
    done
  fi
}

scaling_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    meshes=("$(made torus 40000 ply)" "$(made box 40000 vtk)")
  fi
  # Debian's Python, for which matplotlib is installed.
  /usr/bin/python3 Testing/Benchmarks/scaling.py "$bin" "$results" "${options[@]}" "${meshes[@]}"
}

table3_part() {
  convert_meshes
  if [ ${#meshes[@]} -eq 0 ]; then
    meshes=("$(made torus 250000)" "$(made torus 1000000)" "$(made box 250000)")
  fi
  "$bin/benchmark_table3" "${meshes[@]}" "${options[@]}" --json "$results/table3.json" |
    tee "$results/table3.md"
}

# measure_kernels NAME [MESH.vsm]
measure_kernels() {
  "$bin/benchmark_kernels" "${@:2}" --benchmark_counters_tabular=true \
    --benchmark_out="$results/$1-kernels.json" | tee "$results/$1-kernels.txt"
}

kernels_part() {
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || measure_kernels torus
  for mesh in "${meshes[@]}"; do
    measure_kernels "$(basename "$mesh" .vsm)" "$mesh"
  done
}

convergence_part() {
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000)" "$(made box 250000)")
  "$bin/benchmark_convergence" "${meshes[@]}" --json "$results/convergence.json" |
    tee "$results/convergence.md"
}

schedule_part() {
  local out
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 1000000)" "$(made box 250000)")
  for mesh in "${meshes[@]}"; do
    out=$results/$(basename "$mesh" .vsm)-schedule
    "$bin/benchmark_schedule" "$mesh" --measure --json "$out.json" | tee "$out.md"
  done
}

roofline_part() {
  local out
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 1000000)")
  for mesh in "${meshes[@]}"; do
    out=$results/$(basename "$mesh" .vsm)-roofline
    "$bin/benchmark_roofline" "$mesh" "${options[@]}" --json "$out.json" | tee "$out.md"
  done
}

story_part() {
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 40000 ply)")
  for mesh in "${meshes[@]}"; do
    python3 Testing/Benchmarks/story.py "$bin" "$results" "$mesh" "${options[@]}"
  done
}

"${part}_part"
echo "The tables and numbers are in $results"
