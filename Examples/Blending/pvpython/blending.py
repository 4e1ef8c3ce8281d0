# SPDX-License-Identifier: BSD-3-Clause
"""The light on the Stanford bunny, recorded in four scans of different brightness, becomes seamless,
out of core, with pvpython.

Scans of a real object have such arrays in their file; here two Calculators compute them, piece by
piece.

What this lesson shows:
 1. Filters of ParaView that pass points and cells on may stand between the reader and the blend.
 2. `StreamingBlend` requests the mesh in pieces, removes the steps of the light between the scans on
    scratch files in a fixed amount of memory, and delivers any piece of the blended mesh.
 3. Saving requests one piece after the other, so that a mesh of any size is blended and written.
    Drawing requests the whole mesh: above `MaximumPointsInMemory` this is a preview, which is
    blended in memory.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython blending.py --output .

It writes bunny-blended.vsm, bunny-blended.json (the report) and bunny-blended.png.
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
    """Draws the light of the meshes side by side."""
    layout = CreateLayout()
    for k, mesh in enumerate(meshes):
        view = CreateRenderView()
        AssignViewToLayout(view=view, layout=layout, hint=0 if k == 0 else k)
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [0.93, 0.94, 0.96]
        surface = Show(mesh, view)
        ColorBy(surface, ("POINTS", "Light"))
        GetColorTransferFunction("Light").RescaleTransferFunction(100, 280)
        surface.SetScalarBarVisibility(view, False)
        view.CameraPosition = [-0.12, 0.22, 0.45]
        view.CameraFocalPoint = [-0.017, 0.11, 0.0]
        view.CameraViewUp = [0, 1, 0]
    SaveScreenshot(path, layout, ImageResolution=[1400, 700], CompressionLevel=9)


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "StreamingBlend" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    mesh = StreamingMeshReader(FileName=arguments.mesh)
    scan = Calculator(Input=mesh, ResultArrayName="Scan",
                      Function="(coordsX > -0.02) + 2 * (coordsY > 0.1)")
    light = Calculator(Input=scan, ResultArrayName="Light",
                       Function="128 + 512 * coordsZ + 32 * Scan")
    blend = StreamingBlend(Input=light, Patch="Scan", Arrays=["Light"], MemoryLimit=128)

    # Saving executes the blend. The report is part of the data; its most important numbers are also
    # properties.
    os.makedirs(arguments.output, exist_ok=True)
    result = os.path.join(arguments.output, "bunny-blended")
    SaveData(result + ".vsm", blend)
    blend.UpdatePropertyInformation()
    text = blend.GetPropertyValue("Report")
    if not text:
        sys.exit("The mesh was not blended: see the messages above.")
    report = json.loads(text)
    converged = "converged" if blend.GetPropertyValue("Converged") else "not converged"
    print(f"{report['vertices']} vertices: {converged} in {blend.GetPropertyValue('Passes')} passes")
    for seam in report["seams"]:
        print(f"  {seam['column']}: the largest step between scans was {seam['before']:g} and is "
              f"{seam['after']:g}")
    with open(result + ".json", "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
    draw((light, blend), result + ".png")
    for suffix in (".vsm", ".json", ".png"):
        print(result + suffix)


main()
