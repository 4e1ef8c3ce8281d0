#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Testing/Fuzzing/run.sh [SECONDS [TARGET...]] : builds the fuzzers of the readers of files and
# runs all of them, or the named ones, SECONDS long each (600 unless given), two at a time, from the
# corpus in the tree and the inputs that earlier runs have found. Fails on a finding: a crash, a
# report of a sanitizer, an exception other than Error, an invalid mesh that was accepted, a run of
# more than 5 seconds or 512 MB.
#
#   build-fuzzers/corpus/TARGET    inputs that reach new code, kept from run to run
#   build-fuzzers/findings         TARGET-crash-*, TARGET-timeout-*, TARGET-oom-*: inputs that failed
#   build-fuzzers/logs/TARGET.log  the output of libFuzzer
#
# To reproduce a finding: build-fuzzers/bin/fuzz_TARGET FILE. When the reader is fixed, the input
# goes to Testing/Fuzzing/corpus/TARGET as refused-WHAT, which the test FuzzCorpus then runs
# (without "refused" if it is a mesh that is now read). A new target needs a line in FuzzTargets.cpp,
# unless it is a format, and a folder with a corpus.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export seconds=${1:-600}
shift || true
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_fuzzing_packages[@]}"

cmake --preset fuzzers > /dev/null
cmake --build --preset fuzzers

export build=$PWD/build-fuzzers corpora=$PWD/Testing/Fuzzing/corpus
mkdir -p "$build/findings" "$build/logs"
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  mapfile -t targets < <(ls "$corpora")
fi

# The files of the runs are in memory.
memory=/tmp
[ ! -w /dev/shm ] || memory=/dev/shm
TMPDIR=$(mktemp -d "$memory/smg-fuzzing-XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# The quarantine of freed memory counts towards the 512 MB, too.
export ASAN_OPTIONS=quarantine_size_mb=32:detect_leaks=1

# fuzz TARGET
fuzz() {
  local dictionary=$corpora/../dictionaries/$1.dict options=()
  [ ! -f "$dictionary" ] || options=(-dict="$dictionary")
  mkdir -p "$build/corpus/$1"
  if "$build/bin/fuzz_$1" "${options[@]}" -max_total_time="$seconds" -timeout=5 -rss_limit_mb=512 \
    -max_len=8192 -artifact_prefix="$build/findings/$1-" -print_final_stats=1 \
    "$build/corpus/$1" "$corpora/$1" > "$build/logs/$1.log" 2>&1; then
    echo "$1: $(sed -n 's/^stat::number_of_executed_units: *//p' "$build/logs/$1.log") runs"
  else
    echo "$1: a FINDING, see $build/logs/$1.log"
    return 1
  fi
}
export -f fuzz

printf '%s\n' "${targets[@]}" |
  xargs -P 2 -I TARGET bash -c 'fuzz TARGET' ||
  { echo "There are findings in $build/findings" && exit 1; }
