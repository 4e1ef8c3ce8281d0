# SPDX-License-Identifier: BSD-3-Clause
"""The Stanford bunny turns its head, out of core, with pvpython.

Its base is fixed, its head turned by 70 degrees and scaled by 1.3, an ear turned by 90 degrees; the
rest of the mesh follows and keeps its details. A handle file defines the held regions and their
motion, as for the program smg: `smg deform MESH OUT --handles bunny.json`.

What this lesson shows:
 1. A handle is a filter: `MeshHandle` holds the points in a region, here one of ParaView's implicit
    functions, and stores their motion in point arrays. The filters are chained.
 2. `StreamingMeshDeformation` requests the mesh with these arrays in pieces, solves on scratch files
    in a fixed amount of memory, and delivers any piece of the deformed mesh.
 3. Saving requests one piece after the other, so that a mesh of any size is deformed and written.
    Drawing requests the whole mesh: above `MaximumPointsInMemory` this is a preview, which is
    deformed in memory.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython deformation.py --output .

    34834 vertices, 69451 cells: converged in 11 passes, relative residual 8.7e-08
    bunny-deformed.vsm
    bunny-deformed.json
    bunny-deformed.ply
    bunny-deformed.png

Options select another mesh (--mesh), other handles (--handles), the viewing direction of the picture
(--view, from the mesh to the eye; y points up) and its size (--size). For example the Stanford
Armadillo, scaled to a box of about 1 x 1 x 1, with fixed feet, turned head and raised arm:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython deformation.py --output . \\
        --mesh armadillo.obj --handles ../armadillo.json --view 0.3 0.2 1 --size 1200 700
"""

import argparse
import glob
import json
import os
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy


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
    parser.add_argument("--handles", default=os.path.join(here, "..", "bunny.json"))
    parser.add_argument("--output", default=".", help="folder for the results")
    parser.add_argument("--view", type=float, nargs=3, default=[-0.3, 0.25, 1.0])
    parser.add_argument("--size", type=int, nargs=2, default=[1400, 800])
    return parser.parse_args()


def hold(mesh, region):
    """A Mesh Handle for a region of a handle file, and the centre of spheres and boxes."""
    (shape, numbers), = region.items()
    if shape == "vertices":
        return MeshHandle(Input=mesh, Region="Ids", IdType="Original Ids", Ids=numbers), None
    if shape == "sphere":
        handle = MeshHandle(Input=mesh, RegionFunction="Sphere")
        handle.RegionFunction.Center, handle.RegionFunction.Radius = numbers[:3], numbers[3]
        return handle, numbers[:3]
    if shape == "box":
        handle = MeshHandle(Input=mesh, RegionFunction="Box")
        handle.RegionFunction.UseReferenceBounds = 1
        # Reference bounds are moved by the position and multiplied by the length.
        handle.RegionFunction.Position = [0, 0, 0]
        handle.RegionFunction.Length = [1, 1, 1]
        handle.RegionFunction.Bounds = [numbers[k] for k in (0, 3, 1, 4, 2, 5)]
        return handle, [(numbers[k] + numbers[k + 3]) / 2 for k in range(3)]
    # A half-space: n x >= d. The inside of a plane is the side away from its normal.
    normal, distance = numbers[:3], numbers[3]
    square = sum(n * n for n in normal)
    handle = MeshHandle(Input=mesh, RegionFunction="Plane")
    handle.RegionFunction.Normal = [-n for n in normal]
    handle.RegionFunction.Origin = [n * distance / square for n in normal]
    return handle, None


def take_handles(mesh, handles):
    """The last filter of a chain with one Mesh Handle for each entry."""
    for entry in handles:
        handle, middle = hold(mesh, entry["region"])
        if not entry.get("fixed"):
            handle.Motion = "Similarity"
            rotate = entry.get("rotate", {})
            handle.RotationAxis = rotate.get("axis", [0, 0, 1])
            handle.RotationAngle = rotate.get("degrees", 0)
            handle.Center = rotate.get("center") or entry.get("center") or middle or [0, 0, 0]
            handle.Scale = entry.get("scale", 1)
            handle.Translation = entry.get("translate", [0, 0, 0])
        mesh = handle
    return mesh


def deform(held, options):
    """The deformed mesh, with the options of the handle file."""
    deformation = StreamingMeshDeformation(Input=held)
    deformation.Weights = options.get("weights", "clamped").capitalize()
    deformation.Cycles = options.get("cycles", 0)
    deformation.Tolerance = options.get("tolerance", 1e-6)
    deformation.MemoryLimit = 128
    return deformation


def show(mesh, view, aside):
    """Shows the surface, moved aside; held points are coloured by their rotation angle."""
    moved = Transform(Input=ExtractSurface(Input=mesh))
    moved.Transform.Translate = aside
    turned = Calculator(Input=moved)
    turned.ResultArrayName = "Turned"
    turned.Function = "if(HandleMask > 0, mag(HandleRotation), -1)"
    smooth = (globals().get("SurfaceNormals") or GenerateSurfaceNormals)(Input=turned)
    # Keep the orientation of the triangles: on a preview, which is not a manifold, it cannot be
    # derived.
    smooth.Splitting = smooth.Consistency = 0
    surface = Show(smooth, view)
    ColorBy(surface, ("POINTS", "Turned"))
    surface.InterpolateScalarsBeforeMapping = 0
    surface.Specular = 0.2
    surface.SpecularPower = 30.0
    surface.Ambient = 0.12
    surface.SetScalarBarVisibility(view, False)
    colours = GetColorTransferFunction("Turned")
    colours.ColorSpace = "RGB"
    colours.RGBPoints = [-1.0, 0.84, 0.82, 0.78, 0.0, 0.22, 0.42, 0.69,
                         1.2, 0.93, 0.54, 0.14, 1.6, 0.25, 0.60, 0.30]
    return surface


def extent(mesh, axis):
    """The extent of the mesh, or its preview, in a direction."""
    along = vtk_to_numpy(servermanager.Fetch(mesh).GetPoints().GetData()) @ axis
    return along.min(), along.max()


def draw(before, after, direction, size, path):
    """Draws both meshes side by side, seen from the same direction."""
    view = CreateRenderView()
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.93, 0.94, 0.96]

    direction = direction / numpy.linalg.norm(direction)
    right = numpy.cross([0, 1, 0], direction)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(direction, right)
    (left, middle), (begin, end) = extent(before, right), extent(after, right)
    heights = extent(before, up) + extent(after, up)
    low, high = min(heights), max(heights)
    gap = 0.05 * (high - low)
    show(before, view, [0, 0, 0])
    show(after, view, (middle + gap - begin) * right)
    width, height = middle - left + gap + end - begin, high - low

    view.CameraParallelProjection = 1
    focus = (left + width / 2) * right + (low + height / 2) * up
    view.CameraFocalPoint = focus
    view.CameraPosition = focus + 3 * (width + height) * direction
    view.CameraViewUp = up
    view.CameraParallelScale = 1.1 * max(height, width * size[1] / size[0]) / 2
    SaveScreenshot(path, view, ImageResolution=size, CompressionLevel=9)


def main():
    arguments = parse_arguments()
    if arguments.plugin:
        LoadPlugin(arguments.plugin, ns=globals())
    elif "MeshHandle" not in globals():
        sys.exit("Build the plugin first (bash Examples/run.sh), or name it with --plugin.")
    with open(arguments.handles, encoding="utf-8") as file:
        options = json.load(file)
    mesh = StreamingMeshReader(FileName=arguments.mesh)
    mesh.UpdatePipeline()
    mesh.UpdatePropertyInformation()
    if mesh.GetPropertyValue("FullNumberOfPoints") < 1:
        sys.exit("The mesh cannot be read: see the messages above.")
    held = take_handles(mesh, options["handles"])
    deformation = deform(held, options)

    # Saving executes the solve. The report is part of the data; its most important numbers are also
    # properties.
    os.makedirs(arguments.output, exist_ok=True)
    name = os.path.splitext(os.path.basename(arguments.handles))[0]
    result = os.path.join(arguments.output, name + "-deformed")
    SaveData(result + ".vsm", deformation)
    deformation.UpdatePropertyInformation()
    text = deformation.GetPropertyValue("Report")
    if not text:
        sys.exit("The mesh was not deformed: see the messages above.")
    report = json.loads(text)
    converged = "converged" if deformation.GetPropertyValue("Converged") else "not converged"
    print(f"{report['vertices']} vertices, {report['cells']} cells: {converged} in "
          f"{deformation.GetPropertyValue('Passes')} passes, relative residual "
          f"{deformation.GetPropertyValue('Residual'):.2g}")
    with open(result + ".json", "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)

    # SaveData would use ParaView's own PLY writer, which does not stream.
    servermanager.writers.StreamingMeshWriter(
        Input=deformation, FileName=result + ".ply").UpdatePipeline()

    # The picture also shows the handles.
    deformation.KeepHandleArrays = 1
    draw(held, deformation, arguments.view, arguments.size, result + ".png")
    for suffix in (".vsm", ".json", ".ply", ".png"):
        print(result + suffix)


main()
