#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests on a Debian 12 or 13 machine (as root, or as a user with sudo). By default the first
# of these configurations; continuous integration runs the four after it:
#   quick       build/             main without the tests of Testing/slow.txt, which take over ten seconds each
#   main        build/             ParaView's VTK, plugin, Python; all tests but those of the other
#                                  configurations and the long ones; unity build: names in unnamed
#                                  namespaces must differ
#   lint        build/             format, layers, sizes, licences and documentation of the source
#   vtk         build-vtk/         Debian's standalone VTK, on the libraries Solver and IOCore of build/; the
#                                  tests that use VTK; unity build; with assertions
#   asan-ubsan  build-asan-ubsan/  Solver, IO and smg without VTK, under two sanitizers; unity build; with
#                                  assertions
#   benchmarks  build/             the benchmarks on tiny meshes
#   nightly     build/             what main leaves out since it takes long and seldom fails: the tests of the
#                                  VTK classes on ParaView's VTK, more numbers of processes, Testing/nightly.txt
#   nightly-asan-ubsan  build-asan-ubsan/  what asan-ubsan leaves out, of the same list
#   debug       build-debug/       main without a unity build, where each source must include what it uses;
#                                  with assertions; for daily work
#   tsan        build-tsan/        Solver, IO and smg without VTK, under ThreadSanitizer; unity build; for a
#                                  run every night
# The tests themselves are built for few seconds of compilation: without full optimization. Compilers'
# output is kept by ccache, for clones in other folders as well.
# Stops at the first failing configuration. The last lines say where the time went: the longest tests, the sum
# of each label, the compilation of each target (Testing/times.py).
#
#   run.sh random [--cases N] [--first SEED] [--job JOB] [--door DOOR] [--keep FOLDER]
# runs N random cases of the main configuration instead: see Testing/Random/Check.h.
#
# Environment:
#   SMG_TEST_DATA_DIR   the unpacked archive of test meshes; without it, tests that need it are skipped
#   SMG_CONFIGURATIONS  the configurations to run; default: "quick"
#   SMG_JOBS            parallel compilations and tests; default: one per core
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/packages.sh

jobs=${SMG_JOBS:-$(nproc)}
data=${SMG_TEST_DATA_DIR:-}
[ -z "$data" ] || data=$(realpath "$data")
configurations=${SMG_CONFIGURATIONS:-quick}

# configure PRESET [OPTION...]
configure() {
  cmake --preset "$1" -DSMG_TEST_DATA_DIR="$data" "${@:2}"
}

# configure_build PRESET [OPTION...]
configure_build() {
  echo "== $1: configure, build ($(date +%T))"
  configure "$@"
  cmake --build --preset "$1" --parallel "$jobs"
}

# The libraries and programs of main, built once a run.
build_main() {
  [ -n "${main_is_built:-}" ] || configure_build release
  main_is_built=1
}

# run_tests PRESET [ARGUMENT OF CTEST...]
run_tests() {
  echo "== $1: test ($(date +%T))"
  # One more than cores, since the tests of windows and of processes wait more than they compute. In large
  # pages: where pages are dear, as in virtual machines, a fifth of the time.
  GLIBC_TUNABLES=glibc.malloc.hugetlb=1 ctest --preset "$1" --parallel "$((jobs + 1))" --output-junit tests.xml "${@:2}"
}

# regex_of NAME...
# Those tests alone.
regex_of() {
  echo "^($(printf '%s\n' "$@" | sed 's/\./\\./g' | paste -sd '|'))\$"
}
slow() { regex_of $(sed -e '/^#/d' Testing/slow.txt); }
# nightly CONFIGURATION: the tests that it leaves to the night.
nightly() { regex_of $(awk -v of="$1" '!/^#/ && NF && ($2 ? $2 : "main") == of { print $1 }' Testing/nightly.txt); }

# The programs under sanitizers are compiled while the tests of main leave processors idle. What fails, or is
# not finished then, their own configuration compiles again.
ahead=
begin_sanitizers() {
  if [[ " $configurations " == *" asan-ubsan "* ]]; then
    configure asan-ubsan > /dev/null
    nice -n 15 ninja -C build-asan-ubsan -j 1 > build-asan-ubsan/ahead.log 2>&1 &
    ahead=$!
  fi
}
end_sanitizers() {
  if [ -n "$ahead" ]; then
    kill "$ahead" 2> /dev/null || true
    wait "$ahead" || true
    ahead=
  fi
}

finish() {
  local status=$?
  end_sanitizers
  python3 Testing/times.py "$SECONDS" build build-vtk build-asan-ubsan build-debug build-tsan || true
  exit "$status"
}

smg_install "${smg_build_packages[@]}" "${smg_paraview_packages[@]}" "${smg_test_packages[@]}"
if [ "${1:-}" = random ]; then
  configure_build release
  exec build/bin/vtk_random_problems "${@:2}"
fi
trap finish EXIT
for configuration in $configurations; do
  case $configuration in
    quick)
      build_main
      run_tests release --exclude-regex "$(slow)"
      ;;
    main)
      build_main
      begin_sanitizers
      run_tests release --exclude-regex "$(nightly main)"
      ;;
    vtk)
      build_main
      bash cmake/vtk-prefix.sh build-vtk/vtk
      configure_build vtk
      run_tests vtk
      ;;
    lint)
      build_main
      ctest --test-dir build --label-regex '^lint$' --output-on-failure --no-tests=error
      ;;
    benchmarks)
      configure_build release -DSMG_BUILD_BENCHMARKS=ON
      run_tests benchmarks
      ;;
    nightly)
      configure_build release -DSMG_BUILD_VTK_TESTS=ON
      run_tests nightly
      run_tests release --tests-regex "$(nightly main)"
      ;;
    nightly-asan-ubsan)
      configure_build asan-ubsan
      run_tests asan-ubsan --tests-regex "$(nightly asan-ubsan)"
      ;;
    asan-ubsan)
      end_sanitizers
      configure_build asan-ubsan
      # Of the preset: intercept_tls_get_addr=0, since libasan 8 now and then takes variables of threads in
      # libraries that were opened later for memory of another kind and ends the search for leaks; and
      # LD_LIBRARY_PATH, since its dlopen() knows no DT_RUNPATH.
      run_tests asan-ubsan --exclude-regex "$(nightly asan-ubsan)"
      ;;
    debug | tsan)
      configure_build "$configuration"
      run_tests "$configuration"
      ;;
    *)
      echo "SMG_CONFIGURATIONS: there is no configuration $configuration" >&2
      exit 2
      ;;
  esac
done
