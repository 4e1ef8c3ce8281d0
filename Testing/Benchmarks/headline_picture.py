# SPDX-License-Identifier: BSD-3-Clause
"""headline_picture.py PLUGIN PICTURE NUMBERS BOUNDS TRIANGLES MESH... : draws every triangle of meshes, side by side.

For pvpython. The mapper asks the reader for one piece after the other and draws each into the same image, where the
colours and depths of the pieces before stay: the whole mesh is in the picture, and only a piece in memory. The meshes
have TRIANGLES each, and BOUNDS, in JSON, together; they are looked at along the shortest side. The file
NUMBERS gets, in JSON, the pieces of a mesh and the largest resident memory in MiB, before the first and after the last.
"""
import json
import sys

from paraview.simple import *
from vtkmodules.vtkIOImage import vtkJPEGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
import vtkmodules.vtkRenderingOpenGL2  # implements the classes above

TRIANGLES_OF_PIECE = 250_000
WIDTH, HEIGHT = 700, 640  # of the picture of each mesh


def largest_resident_mib():
    with open("/proc/self/status", encoding="utf-8") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM:")) / 1024


def actor_of(file, pieces):
    reader = StreamingMeshReader(FileName=file, MaximumPointsInMemory=2**31 - 1)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetClientSideObject().GetOutputPort())
    mapper.SetNumberOfSubPieces(pieces)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.80, 0.66, 0.47)
    actor.GetProperty().SetSpecular(0.3)
    actor.GetProperty().SetSpecularPower(25)
    return actor


def look_at(renderer, bounds):
    """Along the shortest side, a little from the side and from above; the second axis points up, if it can."""
    towards = min(range(3), key=lambda d: bounds[2 * d + 1] - bounds[2 * d])
    up = 1 if towards != 1 else 2
    camera = renderer.GetActiveCamera()
    camera.SetPosition([{towards: 1.0, up: 0.15}.get(d, 0.2) for d in range(3)])
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp([float(d == up) for d in range(3)])
    renderer.ResetCamera(bounds)
    camera.Zoom(1.4)
    renderer.ResetCameraClippingRange(bounds)


def main():
    plugin, picture, numbers, bounds, triangles, *meshes = sys.argv[1:]
    pieces = int(triangles) // TRIANGLES_OF_PIECE + 1
    LoadPlugin(plugin, ns=globals())
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(WIDTH * len(meshes), HEIGHT)
    for k, mesh in enumerate(meshes):
        renderer = vtkRenderer()
        renderer.SetViewport(k / len(meshes), 0, (k + 1) / len(meshes), 1)
        renderer.SetBackground(1, 1, 1)
        renderer.GetCullers().RemoveAllItems()  # they would judge by the first piece
        renderer.AddActor(actor_of(mesh, pieces))
        look_at(renderer, json.loads(bounds))
        window.AddRenderer(renderer)
    before = largest_resident_mib()
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.ShouldRerenderOff()
    writer = vtkJPEGWriter()
    writer.SetQuality(90)
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    with open(numbers, "w", encoding="utf-8") as file:
        json.dump({"pieces": pieces, "before_mib": before, "largest_mib": largest_resident_mib()}, file)


main()
