#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests on a Debian 12 or 13 machine (as root, or as a user with sudo). By default the first
# of these configurations; continuous integration runs the first four:
#   main        build/             ParaView's VTK, plugin, Python, benchmarks on tiny meshes; all tests
#                                  except the long ones; unity build: names in unnamed namespaces must
#                                  differ
#   vtk         build-vtk/         Debian's standalone VTK, on the libraries Solver and IOCore of build/; the
#                                  tests that use VTK; unity build; with assertions
#   asan-ubsan  build-asan-ubsan/  Solver, IO and smg without VTK, under two sanitizers; unity build; with
#                                  assertions
#   lint        build/             format, layers, sizes, licences and documentation of the source
#   debug       build-debug/       main without a unity build, where each source must include what it uses;
#                                  with assertions; for daily work
#   tsan        build-tsan/        Solver, IO and smg without VTK, under ThreadSanitizer; unity build; for a
#                                  run every night
# The tests themselves are built for few seconds of compilation: without full optimization.
# Stops at the first failing configuration, with the summary of ctest as its last lines.
#
#   run.sh random [--cases N] [--first SEED] [--job JOB] [--door DOOR] [--keep FOLDER]
# runs N random cases of the main configuration instead: see Testing/Random/Check.h.
#
# Environment:
#   SMG_TEST_DATA_DIR   the unpacked archive of test meshes; without it, tests that need it are skipped
#   SMG_CONFIGURATIONS  the configurations to run; default: "main"
#   SMG_JOBS            parallel compilations and tests; default: one per core
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/packages.sh

jobs=${SMG_JOBS:-$(nproc)}
data=${SMG_TEST_DATA_DIR:-}
[ -z "$data" ] || data=$(realpath "$data")

# configure_build PRESET
configure_build() {
  echo "== $1: configure, build ($(date +%T))"
  local options=(-DSMG_TEST_DATA_DIR="$data")
  [ "$1" != release ] || options+=(-DSMG_BUILD_BENCHMARKS=ON) # their packages are installed
  cmake --preset "$1" "${options[@]}"
  cmake --build --preset "$1" --parallel "$jobs"
}

# configure_build_test PRESET
configure_build_test() {
  configure_build "$1"
  echo "== $1: test ($(date +%T))"
  # One more than cores, since the tests of windows and of processes wait more than they compute.
  ctest --preset "$1" --parallel "$((jobs + 1))"
}

smg_install "${smg_build_packages[@]}" "${smg_paraview_packages[@]}" "${smg_test_packages[@]}"
if [ "${1:-}" = random ]; then
  configure_build release
  exec build/bin/vtk_random_problems "${@:2}"
fi
for configuration in ${SMG_CONFIGURATIONS:-main}; do
  case $configuration in
    main) configure_build_test release ;;
    vtk)
      configure_build release
      bash cmake/vtk-prefix.sh build-vtk/vtk
      configure_build_test vtk
      ;;
    lint)
      configure_build release
      ctest --test-dir build --label-regex '^lint$' --output-on-failure --no-tests=error
      ;;
    asan-ubsan | debug | tsan) configure_build_test "$configuration" ;;
    *)
      echo "SMG_CONFIGURATIONS: there is no configuration $configuration" >&2
      exit 2
      ;;
  esac
done
