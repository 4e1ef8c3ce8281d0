# SPDX-License-Identifier: BSD-3-Clause
"""A harmonic field on the Stanford bunny, out of core, with pvpython.

The field is 0 at the feet and 1 at the tips of the ears; in between it is harmonic: each value is
the weighted mean of its neighbours, like the temperature of a thin shell whose ends are kept at two
temperatures. Deformations, parametrisations and segmentations are based on such fields.

What this lesson shows:
 1. A streaming mesh is opened like any other file. The reader delivers pieces; a mesh with more than
    `MaximumPointsInMemory` points would be shown as a preview.
 2. A problem is described by conditions in regions: a `MeshCondition` prescribes a value in a region,
    here one side of a plane. The filters are chained.
 3. `StreamingPoisson` requests the mesh in pieces, solves on scratch files in a fixed amount of
    memory, and delivers any piece with the solution.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython harmonic_field.py --output .

    34834 vertices, 69451 cells: converged after 6 cycles, relative residual 6.1e-09
    bunny-harmonic.png
    bunny-harmonic.json

Options select another mesh (--mesh) and the heights in metres below and above which the values are
prescribed (--feet, --ears).
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
    parser.add_argument("--output", default=".", help="folder for the picture and the report")
    parser.add_argument("--feet", type=float, default=0.036)
    parser.add_argument("--ears", type=float, default=0.18)
    return parser.parse_args()


def solve(mesh, feet, ears):
    """The mesh with the harmonic field as its point array Solution."""
    # y points up. The inside of a plane is the side opposite to its normal.
    low = MeshCondition(Input=mesh, RegionFunction="Plane", Condition="Dirichlet", Value=0)
    low.RegionFunction.Origin = [0, feet, 0]
    low.RegionFunction.Normal = [0, 1, 0]
    high = MeshCondition(Input=low, RegionFunction="Plane", Condition="Dirichlet", Value=1)
    high.RegionFunction.Origin = [0, ears, 0]
    high.RegionFunction.Normal = [0, -1, 0]

    poisson = StreamingPoisson(Input=high)
    poisson.Weights = "Cotangent"
    poisson.NumberOfPieces = 16
    poisson.UpdatePipeline()
    return poisson


def draw(field, path):
    """Draws the field in bands of colour with isolines between them."""
    view = CreateRenderView()
    view.ViewSize = [1200, 900]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Gradient"
    view.Background = [0.96, 0.97, 0.98]
    view.Background2 = [0.72, 0.78, 0.85]

    bands = 24
    smooth = (globals().get("SurfaceNormals") or GenerateSurfaceNormals)(Input=field)
    smooth.FeatureAngle = 180.0
    surface = Show(smooth, view)
    ColorBy(surface, ("POINTS", "Solution"))
    colours = GetColorTransferFunction("Solution")
    colours.ApplyPreset("Turbo", True)
    colours.RescaleTransferFunction(0.0, 1.0)
    colours.NumberOfTableValues = bands
    surface.Specular = 0.25
    surface.SpecularPower = 30.0
    surface.Ambient = 0.12
    surface.SetScalarBarVisibility(view, False)

    isolines = Contour(Input=field)
    isolines.ContourBy = ["POINTS", "Solution"]
    isolines.Isosurfaces = [i / bands for i in range(1, bands)]
    isolines.ComputeScalars = 0
    lines = Show(isolines, view)
    lines.ColorArrayName = ["POINTS", ""]
    lines.AmbientColor = lines.DiffuseColor = [0.1, 0.1, 0.15]
    lines.LineWidth = 2.0
    lines.Ambient = 1.0
    lines.Diffuse = 0.0

    # The first rendering resets the camera; then move closer.
    Render(view)
    GetActiveCamera().Dolly(1.35)
    view.CenterOfRotation = view.CameraFocalPoint
    SaveScreenshot(path, view, ImageResolution=[1200, 900])


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "StreamingPoisson" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    mesh = OpenDataFile(arguments.mesh)
    field = solve(mesh, arguments.feet, arguments.ears)

    # The report of the solve is part of the data; its most important numbers are also properties.
    field.UpdatePropertyInformation()
    text = field.GetPropertyValue("Report")
    if not text:
        sys.exit("The field was not computed: see the messages above.")
    report = json.loads(text)
    converged = "converged" if field.GetPropertyValue("Converged") else "not converged"
    print(f"{report['vertices']} vertices, {report['cells']} cells: {converged} after "
          f"{field.GetPropertyValue('Cycles')} cycles, relative residual "
          f"{field.GetPropertyValue('Residual'):.2g}")

    os.makedirs(arguments.output, exist_ok=True)
    picture = os.path.join(arguments.output, "bunny-harmonic.png")
    draw(field, picture)
    print(picture)
    path = os.path.join(arguments.output, "bunny-harmonic.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
    print(path)


main()
