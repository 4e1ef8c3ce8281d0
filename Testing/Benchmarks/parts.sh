#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# parts.sh BIN OUT [PART] [--quick] [OPTION VALUE]... [MESH...] : a part of run.sh, whose comment has the
# parts and options, with the programs of the folder BIN; tables and meshes go to the folder OUT.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$(realpath "$1")
mkdir -p "$2"
results=$(realpath "$2")
shift 2
all_parts=(solve convergence discretisation scaling schedule convert estimates python kernels roofline
  checkpoint distance simplification smoothing story table3 headline largest orders)
part=solve
if [[ " all ${all_parts[*]} " == *" ${1:-solve} "* ]]; then
  part=${1:-solve}
  shift || true
fi
meshes=()
options=()
quick=
from=
while [ $# -gt 0 ]; do
  case "$part$1" in
    *--quick) quick=--quick ;;
    all--from)
      from=${2:?"$1 needs a part"}
      shift
      [[ " ${all_parts[*]} " == *" $from "* ]] || {
        echo "there is no part $from: see run.sh" >&2
        exit 2
      }
      ;;
    convert--memory | convert--orders | convert--address-space | scaling--to | scaling--peers-to | \
      table3--threads | headline--times | headline--memory | headline--plugin | roofline--scratch | \
      roofline--threads | roofline--file | story--times | story--memory | story--size | \
      story--source | story--plugin | largest--times | python--vertices)
      options+=("$1" "${2:?"$1 needs a value"}")
      shift
      ;;
    *--*)
      echo "$part has no option $1: see run.sh" >&2
      exit 2
      ;;
    *) meshes+=("$(realpath -e -- "$1")") ;;
  esac
  shift
done
data=${SMG_TEST_DATA_DIR:+$(realpath "$SMG_TEST_DATA_DIR")}
[ -z "$data" ] || [ ! -d "$data/meshes" ] || data=$data/meshes
[ -z "$quick" ] || data=
python=/usr/bin/python3 # Debian's, for which matplotlib and ParaView's modules are installed
plugin=$(ls "$here"/../../build/lib/paraview-*/plugins/StreamingMultigrid/StreamingMultigrid.so 2> /dev/null || true)
seconds=(${quick:+--benchmark_min_time=0.01})
cd "$results" # where some scripts leave files

# made SHAPE VERTICES [SUFFIX] : makes the mesh, a stream unless SUFFIX says else, prints its name
made() {
  local vertices=$2 suffix=${3:-vsm}
  # A torus of 20000 has two levels to measure.
  [ -z "$quick" ] || { [ "$1$suffix" = torusvsm ] && vertices=20000 || vertices=3000; }
  "$bin/make_mesh" "$1" "$vertices" "$results/$1-$2.$suffix" >&2
  echo "$results/$1-$2.$suffix"
}

# refined MESH TIMES SUFFIX : the mesh refined and shuffled, triangles as .ply and tetrahedra as .vtk;
# prints its name, which has the number of cells that a cell becomes
refined() {
  local name children=4
  [ "$3" = ply ] || children=8
  name=$(basename "$1")
  name=$results/${name%.*}-x$((children ** $2)).$3
  if [ ! -e "$name" ]; then
    "$bin/make_mesh" finer "$1" "$2" "$name.part.$3" --shuffle >&2 && mv "$name.part.$3" "$name" || return 1
  fi
  echo "$name"
}

# Converts those meshes that are not streams.
convert_meshes() {
  local i name
  for i in "${!meshes[@]}"; do
    if [[ ${meshes[i]} != *.vsm ]]; then
      name=$(basename "${meshes[i]}")
      "$bin/smg" convert "${meshes[i]}" "$results/${name%.*}.vsm" --quiet
      meshes[i]=$results/${name%.*}.vsm
    fi
  done
}

# measure_preview MESH.vsm
measure_preview() {
  "$bin/benchmark_interactive" "$1" "${seconds[@]}" --benchmark_counters_tabular=true \
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
  # VTK's reader may fail.
  if [[ $1 == *.@(ply|vtk) ]] && "$python" -c "import vtkmodules" 2> /dev/null; then
    "$python" "$here/read_with_vtk.py" "$1" "$out-vtk.json" | tee -a "$out.md" ||
      echo "VTK does not read $1" | tee -a "$out.md"
  fi
}

convert_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    meshes=("$(refined "$(made torus 250000 ply)" 1 ply)" "$(refined "$(made box 64000 vtk)" 1 vtk)")
  fi
  [ -z "$quick" ] || options+=(--memory "16,64")
  for mesh in "${meshes[@]}"; do
    measure_conversion "$mesh"
  done
}

solve_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    measure "$(made torus 250000)"
    [ -n "$quick" ] || measure "$(made torus 1000000)"
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
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 40000 ply)" "$(made box 40000 vtk)")
  [ -z "$quick" ] || options+=(--to 15000 --peers-to 5000)
  "$python" "$here/scaling.py" "$bin" "$results" "${options[@]}" "${meshes[@]}"
}

table3_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    [ -z "$quick" ] || meshes=("$(made torus 250000)")
    [ -z "$data" ] || options+=(--data "$data")
  fi
  "$python" "$here/table3.py" "$bin" "$results" "${meshes[@]}" "${options[@]}"
}

headline_part() {
  if [ ${#meshes[@]} -eq 0 ]; then
    [ -z "$data" ] && meshes=("$(made torus 4000 ply)") || options+=(--data "$data")
    [ -z "$plugin" ] || [ -n "$quick" ] || options+=(--plugin "$plugin")
  fi
  [ -z "$quick" ] || options+=(--times 1)
  "$python" "$here/headline.py" "$bin" "$results" "${meshes[@]}" "${options[@]}"
}

# measure_kernels NAME [MESH.vsm]
measure_kernels() {
  "$bin/benchmark_kernels" "${@:2}" "${seconds[@]}" --benchmark_counters_tabular=true \
    --benchmark_out="$results/$1-kernels.json" | tee "$results/$1-kernels.txt"
}

kernels_part() {
  [ -z "$quick" ] || meshes=("$(made torus 250000)")
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || measure_kernels torus
  for mesh in "${meshes[@]}"; do
    measure_kernels "$(basename "$mesh" .vsm)" "$mesh"
  done
}

convergence_part() {
  local mesh out
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000)" "$(made box 250000)")
  "$bin/benchmark_convergence" "${meshes[@]}" --json "$results/convergence.json" |
    tee "$results/convergence.md"
  for mesh in "${meshes[@]}"; do
    out=$results/$(basename "$mesh" .vsm)-hypre
    "$bin/benchmark_peers" "$mesh" --peers smg,hypre --json "$out.json" | tee "$out.md"
    "$bin/benchmark_peers" "$mesh" --peers smg,hypre --from-zero --json "$out-zero.json" | tee "$out-zero.md"
  done
}

discretisation_part() {
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000)" "$(made box 250000)")
  "$python" "$here/discretisation.py" "$bin/smg" "${meshes[@]}" | tee "$results/discretisation.md"
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
  [ -z "$quick" ] || options+=(--scratch "$results" --file 16 --arrays 16)
  for mesh in "${meshes[@]}"; do
    out=$results/$(basename "$mesh" .vsm)-roofline
    "$bin/benchmark_roofline" "$mesh" "${options[@]}" --json "$out.json" | tee "$out.md"
  done
}

story_part() {
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 40000 ply)")
  [ -z "$quick" ] || options+=(--times 1)
  for mesh in "${meshes[@]}"; do
    "$python" "$here/story.py" "$bin" "$results" "$mesh" "${options[@]}"
  done
}

largest_part() {
  [ ${#meshes[@]} -gt 0 ] || {
    meshes=("$(made torus 40000 ply)")
    options+=(--times "$([ -n "$quick" ] && echo 1 || echo 4)")
  }
  "$python" "$here/largest.py" "$bin" "$results" "${meshes[0]}" "${options[@]}"
}

estimates_part() {
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 1000000)" "$(made box 250000)")
  "$python" "$here/estimates.py" "$bin/smg" "${meshes[@]}" | tee "$results/estimates.md"
}

python_part() {
  local vertices=${options[1]:-${quick:+3000}}
  PYTHONPATH=$bin/../lib/python3/dist-packages \
    "$python" "$here/python.py" "$bin/smg" "${vertices:-1000000}" | tee "$results/python.md"
}

checkpoint_part() {
  convert_meshes
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000)")
  "$python" "$here/checkpoint.py" "$bin/smg" "${meshes[0]}" | tee "$results/checkpoint.md"
}

distance_part() {
  local vertex=21000
  if [ ${#meshes[@]} -eq 0 ]; then
    meshes=("$(made torus 250000 ply)")
    vertex=1000
  fi
  convert_meshes
  "$python" "$here/distance.py" "$bin/smg" "$vertex" "${meshes[@]}" | tee "$results/distance.md"
  if has_modules streamingmultigrid; then
    "$python" "$here/distance_regions.py" | tee "$results/distance_regions.md"
  fi
}

orders_part() {
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000 ply)")
  "$python" "$here/orders.py" "$bin/smg" "$results" "${meshes[@]}" | tee "$results/orders.md"
}

# has_modules NAME... : whether Python has them; says so if not
has_modules() {
  "$python" -c "import $*" 2> /dev/null || {
    echo "$part is left out: Python has not all of: $*"
    return 1
  }
}

simplification_part() {
  has_modules "vtkmodules, numpy" || return 0
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000 ply)")
  "$python" "$here/simplification.py" "$bin/smg" "$([ -n "$quick" ] && echo 500 || echo 20000)" \
    "${meshes[@]}" | tee "$results/simplification.md"
}

smoothing_part() {
  has_modules "vtkmodules, numpy, scipy" || return 0
  [ ${#meshes[@]} -gt 0 ] || meshes=("$(made torus 250000 ply)")
  "$python" "$here/smoothing.py" "$bin/smg" "${meshes[@]}" | tee "$results/smoothing.md"
}

# arguments_of PART : prints its meshes, those of docs/performance.md, made of the archive, and options
arguments_of() {
  local armadillo=$data/armadillo43k.obj head=$data/head_tet336k.vtk
  case $1 in
    solve) refined "$armadillo" 2 ply && refined "$armadillo" 3 ply ;;
    convergence | discretisation)
      "$bin/smg" convert "$data/bunny_tet.mesh" "$results/bunny_tet.vsm" --cells tets --quiet >&2 &&
        refined "$armadillo" 2 ply && refined "$head" 1 vtk && made gyroid 860000 &&
        printf '%s\n' "$data/dragon.ply" "$head" "$results/bunny_tet.vsm" &&
        { [ "$1" = convergence ] || refined "$armadillo" 3 ply; }
      ;;
    scaling) printf '%s\n' --to 12000000 --peers-to 100000 "$armadillo" "$head" ;;
    schedule) refined "$armadillo" 3 ply && refined "$head" 2 vtk ;;
    convert)
      printf '%s\n' --memory 256 --orders bfs "$data/head_mri_1m.ply" &&
        refined "$armadillo" 3 ply && refined "$armadillo" 4 ply && refined "$head" 2 vtk
      ;;
    estimates) printf '%s\n' "$data"/{brain168k.vtk,head_tet336k.vtk,head_mri_1m.ply} ;;
    story)
      printf '%s\n' --times 5 "$armadillo"
      [ -z "$plugin" ] || printf '%s\n' --plugin "$plugin"
      ;;
    checkpoint) refined "$armadillo" 4 ply ;;
    distance) printf '%s\n' "$armadillo" && refined "$armadillo" 2 ply && refined "$armadillo" 3 ply ;;
    simplification) printf '%s\n' "$data"/{dragon,head_mri_1m}.ply ;;
    smoothing) refined "$armadillo" 2 ply && echo "$data/dragon.ply" ;;
    largest) printf '%s\n' "$armadillo" ;;
    orders) printf '%s\n' "$data"/{dragon.ply,brain168k.vtk,head_mri_1m.ply,head_tet336k.vtk} ;;
  esac
}

# all.md says what was measured where, of which commit, and how long each part took.
all_part() {
  local lines arguments commit begin outcome failed=()
  commit=$(git -C "$here" log -1 --format=%h 2> /dev/null || true)
  [ -n "$from" ] || {
    "$python" "$here/machine.py"
    printf '\n| part | commit | seconds |\n|---|---|---|\n'
  } > all.md
  for part in "${all_parts[@]}"; do
    [ "$part" != "$from" ] || from=
    [ -z "$from" ] || continue
    echo "== $part ($(date +%T))"
    begin=$SECONDS
    outcome=failed
    lines=
    if [ -z "$data" ] || lines=$(arguments_of "$part"); then
      mapfile -t arguments < <(printf '%s' "$lines")
      bash "$here/parts.sh" "$bin" "$results" "$part" $quick "${arguments[@]}" && outcome=
    fi
    [ -z "$outcome" ] || failed+=("$part")
    echo "| $part | $commit | $((SECONDS - begin))${outcome:+ $outcome} |" >> all.md
  done
  cat all.md
  [ ${#failed[@]} -eq 0 ] || echo "These parts failed: ${failed[*]}" >&2
  return ${#failed[@]}
}

"${part}_part"
echo "The tables and numbers are in $results"
