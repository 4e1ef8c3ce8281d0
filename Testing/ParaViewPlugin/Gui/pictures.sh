#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# pictures.sh [SESSION...] : makes the pictures of Examples/*/gui anew, of all sessions or of these,
# with the ParaView and the build of the tree; about a minute each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
plugin=$(ls "$PWD"/build/lib/paraview-*/plugins/StreamingMultigrid/StreamingMultigrid.so)
export SMG_PROGRAM=$PWD/build/bin/smg
# Some pictures show the names of files.
folder=/tmp/lesson
mkdir "$folder"
trap 'rm -rf "$folder"' EXIT

# session, mesh, lesson, and the pictures: that of the session, and its name in the lesson.
while read -r session mesh lesson pictures; do
  if [ $# -gt 0 ] && [[ " $* " != *" $session "* ]]; then
    continue
  fi
  cp "Examples/Data/$mesh" "$folder"
  pvpython "Testing/ParaViewPlugin/Gui/$session.py" "$plugin" "$folder/$mesh" \
    "$folder/$session" --pictures "$folder/pictures" < /dev/null
  for picture in $pictures; do
    cp "$folder/pictures/${picture%%=*}.png" "Examples/$lesson/gui/${picture##*=}.png"
  done
done << 'END'
deformation bunny.smb Deformation opened=opened handles=handles deformed=deformed dragged=dragged reopened=reopened
poisson bunny.smb HarmonicField condition-1=condition solved-in-full=solved last-solve=last-solve
heat heat_sink.msh HeatConduction heat-part=part heat-conditions=air heat-solved=solved
smoothing bunny.smb Smoothing smoothing-defaults=defaults smoothing-size=size smoothing-outcome=outcome
blending bunny.smb Blending blending-recorded=recorded blending-blended=blended
distance bunny.smb Distance distance-region=region distance-boundary=boundary
END
