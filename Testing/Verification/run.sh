#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Verification/run.sh : repeats the computations of docs/verification.md and rewrites its tables.
#
# Uses the archive of meshes named by the environment variable SMG_TEST_DATA_DIR; installs missing
# packages, builds smg and the benchmarks without VTK in build-benchmarks, and leaves the numbers in
# build-benchmarks/verification. The direct solves take half an hour on two cores; they are kept in
# build-benchmarks/verification/answers for the next run.
set -euo pipefail
SMG_TEST_DATA_DIR=$(realpath -e "${SMG_TEST_DATA_DIR:?"must name the unpacked archive of meshes"}")
export SMG_TEST_DATA_DIR
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_verification_packages[@]}"

cmake --preset benchmarks > /dev/null
cmake --build --preset benchmarks --target smg benchmark_peers
bin=$PWD/build-benchmarks/bin
results=$PWD/build-benchmarks/verification
mkdir -p "$results/answers"

# Debian's Python, for which SciPy is installed.
data=$SMG_TEST_DATA_DIR
/usr/bin/python3 Testing/Verification/finite_elements_test.py "$bin/smg" "$data/raptor_tet.vtu" \
  "$data/bunny_tet.mesh" "$data/armadillo_tet.msh" "$data/bunny.ply" "$data/lucy50k.ply"
/usr/bin/python3 Testing/Verification/convergence.py "$bin/smg" --out "$results"
for mesh in "$data"/*.*; do
  name=$(basename "${mesh%.*}")
  cells=()
  [ "$name" != bunny_tet ] || cells=(--cells tets)
  "$bin/smg" convert "$mesh" "$results/$name.vsm" --quiet "${cells[@]}"
  for tolerance in 1e-6 1e-10; do
    "$bin/benchmark_peers" "$results/$name.vsm" --peers smg,hypre --tolerance "$tolerance" \
      --json "$results/peers-$tolerance-$name.json"
  done
done
status=0
/usr/bin/python3 Testing/Verification/verify.py "$bin/smg" --json "$results/verify.json" \
  --answers "$results/answers" archive ||
  status=$?
/usr/bin/python3 Testing/Verification/tables.py "$results" docs
exit "$status"
