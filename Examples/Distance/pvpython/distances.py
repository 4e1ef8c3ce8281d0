# SPDX-License-Identifier: BSD-3-Clause
"""Distances along the surface of the Stanford bunny from the tip of an ear, out of core, with
pvpython.

What this lesson shows:
 1. `StreamingDistance` requests the mesh in pieces, marches a front through a window of it on scratch
    files in a fixed amount of memory, and delivers any piece of the mesh with its distances.
 2. `From` names a part of the mesh in the JSON of problem files. Without it, the sources are what
    Mesh Handles before the filter hold.
 3. Saving requests one piece after the other, so that the distances on a mesh of any size are
    computed and written. Drawing requests the whole mesh: above `MaximumPointsInMemory` this is a
    preview, on which distances are computed in memory.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython distances.py --output .

It writes bunny-distance.vsm, bunny-distance.json (the report) and bunny-distance.png.
"""

import argparse
import glob
import json
import os
import sys

from paraview.simple import *


def find_plugin(here):
    """The plugin built by `bash Examples/run.sh`; None if there is none."""
    build = os.path.join(here, "..", "..", "..", "build")
    found = glob.glob(os.path.join(build, "lib", "*", "plugins", "*", "StreamingMultigrid.so"))
    return found[0] if found else None


def parse_arguments():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plugin", default=find_plugin(here),
                        help="StreamingMultigrid.so; default: that of the tree's build folder, if any")
    parser.add_argument("--mesh", default=os.path.join(here, "..", "..", "Data", "bunny.smb"))
    parser.add_argument("--output", default=".", help="folder for the results")
    return parser.parse_args()


def draw(distance, path):
    """Draws the distances with isolines every centimetre."""
    view = CreateRenderView()
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.93, 0.94, 0.96]
    surface = Show(distance, view)
    ColorBy(surface, ("POINTS", "Distance"))
    surface.SetScalarBarVisibility(view, False)
    isolines = Contour(Input=distance, ContourBy=["POINTS", "Distance"],
                       Isosurfaces=[0.01 * k for k in range(1, 40)])
    lines = Show(isolines, view)
    ColorBy(lines, None)
    lines.DiffuseColor = [0.1, 0.1, 0.15]
    lines.AmbientColor = [0.1, 0.1, 0.15]
    lines.LineWidth = 3
    lines.RenderLinesAsTubes = 1
    view.CameraPosition = [-0.10, 0.19, 0.34]
    view.CameraFocalPoint = [-0.017, 0.11, 0.0]
    view.CameraViewUp = [0, 1, 0]
    SaveScreenshot(path, view, ImageResolution=[900, 800], CompressionLevel=9)


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "StreamingDistance" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    mesh = StreamingMeshReader(FileName=arguments.mesh)
    distance = StreamingDistance(Input=mesh, MemoryLimit=128)
    distance.From = '{"nearest": [[-0.0175, 0.187, -0.02]]}'

    # Saving computes the distances. The report is part of the data; its most important numbers are
    # also properties.
    os.makedirs(arguments.output, exist_ok=True)
    result = os.path.join(arguments.output, "bunny-distance")
    SaveData(result + ".vsm", distance)
    distance.UpdatePropertyInformation()
    text = distance.GetPropertyValue("Report")
    if not text:
        sys.exit("There are no distances: see the messages above.")
    report = json.loads(text)
    settled = "settled" if distance.GetPropertyValue("Converged") else "not settled"
    print(f"{report['vertices']} vertices: {settled} in {report['passes']} "
          f"{'pass' if report['passes'] == 1 else 'passes'}")
    print(f"  the largest distance is {report['distance']['maximum']:g} m, the mean "
          f"{report['distance']['mean']:g} m")
    with open(result + ".json", "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
    draw(distance, result + ".png")
    for suffix in (".vsm", ".json", ".png"):
        print(result + suffix)


main()
