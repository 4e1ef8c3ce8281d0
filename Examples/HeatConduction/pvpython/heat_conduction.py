# SPDX-License-Identifier: BSD-3-Clause
"""Heat conduction in a chip and its heat sink, out of core, with pvpython.

Two materials conduct heat: the ceramic of the chip with 25 W/(m K), the aluminium of the heat sink
with 200 W/(m K). The chip makes 50 MW/m^3, 19.6 W in all; 10 kW/m^2 leave through its solder, and air
of 20 degrees cools the heat sink with 50 W/(m^2 K). The sides of the chip are insulated. All places
are names that the mesher has given: see heat_sink.geo.

What this lesson shows:
 1. A condition is a filter: `MeshCondition` sets a condition in a region, here in a group of the mesh.
    The filters are chained.
 2. `StreamingPoisson` requests the mesh with these conditions in pieces, solves on scratch files in a
    fixed amount of memory, and delivers any piece with the solution and the flux in the cells. Its
    report contains the flow through each condition.
 3. The writer requests one piece after the other, so that a mesh of any size is solved and written.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython heat_conduction.py --output .

    1740 vertices, 5359 cells: converged after 8 cycles, relative residual 7.3e-10
    peak: 77.748 degrees at vertex 515 of the file
    flux[0] (solder): -1.96 W into the body through 196 mm^2 of 76.5038 degrees
    robin[0] (air): -17.64 W into the body through 6980 mm^2 of 70.5444 degrees
    relative imbalance of all flows: 6e-14
    heat.vtu
    heat.json
    heat.png
"""

import argparse
import glob
import json
import os
import sys

from paraview import servermanager
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
    parser.add_argument("--mesh", default=os.path.join(here, "..", "..", "Data", "heat_sink.msh"))
    parser.add_argument("--output", default=".", help="folder for the results")
    return parser.parse_args()


def conditions(mesh):
    """The last filter of a chain of Mesh Conditions. Lengths are in metres, as in the mesh."""
    ceramic = MeshCondition(Input=mesh, Region="Group", GroupName="chip", Condition="Conductivity", Value=25)
    aluminium = MeshCondition(Input=ceramic, Region="Group", GroupName="heat sink", Condition="Conductivity", Value=200)
    power = MeshCondition(Input=aluminium, Region="Group", GroupName="chip", Condition="Source", Value=5e7)
    board = MeshCondition(Input=power, Region="Group", GroupName="solder", Condition="Flux", Value=-10000)
    air = MeshCondition(Input=board, Region="Group", GroupName="air", Condition="Robin", Value=20)
    air.Coefficient = 50
    return air


def draw(heat, path):
    """Draws the body, and a half of it cut through the middle, in bands of colour."""
    low, high = heat.PointData["Solution"].GetRange()
    colours = GetColorTransferFunction("Solution")
    colours.ApplyPreset("Turbo", True)
    colours.RescaleTransferFunction(low, high)
    colours.NumberOfTableValues = 24
    half = Clip(Input=heat, ClipType="Plane", Invert=0)
    half.ClipType.Origin = [0.017, 0.017, 0.009]
    half.ClipType.Normal = [0, 1, 0]

    layout = CreateLayout("Heat")
    layout.SplitHorizontal(0, 0.5)
    for place, (body, rise) in enumerate(((heat, 0.7), (half, -0.35))):
        view = CreateRenderView()
        AssignViewToLayout(view=view, layout=layout, hint=1 + place)
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [0.93, 0.94, 0.96]
        surface = Show(body, view)
        ColorBy(surface, ("POINTS", "Solution"))
        surface.Ambient = 0.45
        surface.SetScalarBarVisibility(view, False)
        view.CameraFocalPoint = [0.017, 0.017, 0.008]
        view.CameraPosition = [0.017 - 0.04, 0.017 - 0.1, 0.008 + 0.1 * rise]
        view.CameraViewUp = [0, 0, 1]
        view.CameraParallelProjection = 1
        view.CameraParallelScale = 0.0225
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = "degrees", ""
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.15]
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    bar.ScalarBarLength = 0.6
    bar.UseCustomLabels, bar.CustomLabels = 1, [72, 75]
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.0f", "%.0f"
    bar.Visibility = 1
    SaveScreenshot(path, layout, ImageResolution=[1400, 600], CompressionLevel=9)


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "MeshCondition" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    mesh = StreamingMeshReader(FileName=arguments.mesh)
    heat = StreamingPoisson(Input=conditions(mesh), Gradient=1, Flux=1, MemoryLimit=64)

    # Writing executes the solve. The report is part of the data; its most important numbers are
    # also properties.
    os.makedirs(arguments.output, exist_ok=True)
    result = os.path.join(arguments.output, "heat")
    servermanager.writers.StreamingMeshWriter(Input=heat, FileName=result + ".vtu").UpdatePipeline()
    heat.UpdatePropertyInformation()
    text = heat.GetPropertyValue("Report")
    if not text:
        sys.exit("The problem was not solved: see the messages above.")
    report = json.loads(text)
    converged = "converged" if heat.GetPropertyValue("Converged") else "not converged"
    print(f"{report['vertices']} vertices, {report['cells']} cells: {converged} after "
          f"{heat.GetPropertyValue('Cycles')} cycles, relative residual "
          f"{heat.GetPropertyValue('Residual'):.2g}")
    peak = report["maximum"][0]
    print(f"peak: {peak['value']:.6g} degrees at vertex {peak['vertex']} of the file")
    for condition in report["conditions"]:
        print(f"{condition['name']}: {condition['flux'][0]:.6g} W into the body through "
              f"{1e6 * condition['area']:.6g} mm^2 of {condition['mean'][0]:.6g} degrees")
    print(f"relative imbalance of all flows: {report['balance'][0]:.2g}")
    with open(result + ".json", "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)

    draw(heat, result + ".png")
    for suffix in (".vtu", ".json", ".png"):
        print(result + suffix)


main()
