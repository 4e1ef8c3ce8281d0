#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# packages.sh : builds the Debian packages, installs, uses and removes them on this machine. In a fresh
# system: bash Testing/Platforms/run.sh SUITE bash Testing/Platforms/packages.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tree=$PWD
source cmake/packages.sh
smg_install "${smg_build_packages[@]}" "${smg_paraview_packages[@]}" dpkg-dev file
smg_say_so cmake --preset packages
smg_say_so cmake --build --preset packages
(cd build-packages && rm -f ./*.deb && smg_say_so cpack)

work=$(mktemp -d)
installed=
clean() {
  rm -rf "$work"
  [ -z "$installed" ] || smg_as_root apt-get remove -y -qq streaming-multigrid > /dev/null
}
trap clean EXIT
cp build-packages/*.deb "$work"
installed=1
smg_as_root apt-get install -y -qq --no-install-recommends --no-remove "$work"/*.deb

cd "$work"
smg --version
smg convert "$tree/Examples/Data/bunny.smb" bunny.vtp --quiet
smg info bunny.vtp --quiet --report info.json
grep -q '"vertices": *34834' info.json
/usr/bin/python3 -c 'import streamingmultigrid as smg; assert smg.open("bunny.vtp").n_vertices == 34834'

cat > plugin.py << 'END'
from paraview.simple import *

LoadDistributedPlugin("StreamingMultigrid", ns=globals())
mesh = StreamingMeshReader(FileName="bunny.vtp")
held = MeshHandle(Input=mesh, RegionFunction="Plane")
held.RegionFunction.Origin, held.RegionFunction.Normal = [0, 0.05, 0], [0, 1, 0]
SaveData("deformed.vsm", StreamingMeshDeformation(Input=held))
END
xvfb-run -a pvpython plugin.py
smg info deformed.vsm --check

for project in Lessons CustomOperators Filters; do
  cmake -S "$tree/Testing/Install/$project" -B "$project" -DCMAKE_BUILD_TYPE=Release
  cmake --build "$project"
  ctest --test-dir "$project" --output-on-failure --no-tests=error
done

smg_as_root apt-get remove -y -qq streaming-multigrid > /dev/null
installed=
[ ! -e /usr/bin/smg ]
echo "The packages can be installed, used and removed:"
ls "$tree"/build-packages/*.deb
