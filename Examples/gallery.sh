#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# gallery.sh : draws the pictures of docs/gallery.md with the lessons' pvpython scripts, after
# `bash Examples/run.sh`, and leaves them where the documents show them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
for script in */pvpython/*.py; do
  lesson=${script%%/*}
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython "$script" --output "$output/$lesson"
  for picture in "$output/$lesson"/*.png; do
    cp "$picture" "$lesson/"
    echo "Examples/$lesson/$(basename "$picture")"
  done
done
