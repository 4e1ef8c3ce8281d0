#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# report_page.sh SMG : draws report-page.png, the page of the report of the harmonic field in solve.md, by
# Chromium, in an empty temporary folder.
set -euo pipefail
smg=$(realpath "$1")
docs=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export PATH="$(dirname "$smg"):$PATH"
cat > problem.json << 'END'
{ "dirichlet": [ { "halfspace": [0, 1, 0, 0.18], "value": [1] },
                 { "halfspace": [0, -1, 0, -0.036], "value": [0] } ] }
END
smg convert "$docs/../Examples/Data/bunny.smb" bunny.vsm --quiet
smg solve bunny.vsm out.vsm --problem problem.json --memory 256 --report report.html > /dev/null
chromium --headless --no-sandbox --disable-dev-shm-usage --hide-scrollbars --user-data-dir="$folder/profile" \
  --window-size=1160,2105 --use-angle=swiftshader --enable-unsafe-swiftshader \
  --screenshot="$docs/pictures/report-page.png" "file://$folder/report.html" 2> /dev/null
