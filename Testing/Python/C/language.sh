#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# language.sh SMG PROGRAM... : the program solves as smg does, and writes the same file.
set -euo pipefail
smg=$1
shift
command -v "$1" > /dev/null || { echo "SKIPPED: $1 is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export GOCACHE="$folder/cache"
mesh="$SMG_SOURCE_DIR/Examples/Data/bunny.smb"
echo '{"dirichlet": [{"vertices": [0], "value": 0}, {"vertices": [9999], "value": 1}]}' \
  > "$folder/problem.json"
"$smg" solve "$mesh" "$folder/smg.vtu" --problem "$folder/problem.json" --quiet
"$@" "$mesh" "$folder/other.vtu"
cmp "$folder/smg.vtu" "$folder/other.vtu"
if "$@" "$folder/none.smb" "$folder/no.vtu" 2> "$folder/error"; then
  echo "a mesh that does not exist is no error"
  exit 1
fi
grep -q 'none.smb' "$folder/error"
