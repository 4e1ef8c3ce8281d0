# SPDX-License-Identifier: BSD-3-Clause
"""The Stanford bunny becomes smooth except for its head, out of core, with pvpython.

The fur is a detail of a few millimetres: two implicit steps halve waves of 1 cm. The head is held.

What this lesson shows:
 1. `StreamingMeshSmoothing` requests the mesh in pieces, takes its steps on scratch files in a fixed
    amount of memory, and delivers any piece of the smoothed mesh.
 2. `Hold` names the parts that do not move in the JSON of problem files. A chain of Mesh Handles
    before the filter can select them, too: {"mask": "HandleMask"}.
 3. Saving requests one piece after the other, so that a mesh of any size is smoothed and written.
    Drawing requests the whole mesh: above `MaximumPointsInMemory` this is a preview, which is
    smoothed in memory.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython smoothing.py --output .

It writes bunny-smooth.vsm, bunny-smooth.json (the report) and bunny-smooth.png.
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


def draw(meshes, path):
    """Draws the meshes side by side."""
    layout = CreateLayout()
    for k, mesh in enumerate(meshes):
        view = CreateRenderView()
        AssignViewToLayout(view=view, layout=layout, hint=0 if k == 0 else k)
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [0.93, 0.94, 0.96]
        surface = Show(mesh, view)
        surface.ColorArrayName = ["POINTS", ""]
        surface.DiffuseColor = [0.84, 0.82, 0.78]
        surface.Interpolation = "Flat"
        view.CameraPosition = [-0.12, 0.22, 0.45]
        view.CameraFocalPoint = [-0.017, 0.11, 0.0]
        view.CameraViewUp = [0, 1, 0]
    SaveScreenshot(path, layout, ImageResolution=[1400, 700], CompressionLevel=9)


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "StreamingMeshSmoothing" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    mesh = StreamingMeshReader(FileName=arguments.mesh)
    smoothing = StreamingMeshSmoothing(Input=mesh, MemoryLimit=128)
    smoothing.SizeUnit = "Mesh Unit"
    smoothing.Size = 0.01  # the unit of the bunny is 1 m
    smoothing.Steps = 2
    smoothing.Hold = '{"sphere": [-0.07, 0.14, 0.01, 0.04]}'

    # Saving executes the steps. The report is part of the data; its most important numbers are also
    # properties.
    os.makedirs(arguments.output, exist_ok=True)
    result = os.path.join(arguments.output, "bunny-smooth")
    SaveData(result + ".vsm", smoothing)
    smoothing.UpdatePropertyInformation()
    text = smoothing.GetPropertyValue("Report")
    if not text:
        sys.exit("The mesh was not smoothed: see the messages above.")
    report = json.loads(text)
    converged = "converged" if smoothing.GetPropertyValue("Converged") else "not converged"
    print(f"{report['vertices']} vertices, {report['prescribed']} held: {converged} in "
          f"{smoothing.GetPropertyValue('Passes')} passes")
    with open(result + ".json", "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
    draw((mesh, smoothing), result + ".png")
    for suffix in (".vsm", ".json", ".png"):
        print(result + suffix)


main()
