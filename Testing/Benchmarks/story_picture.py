# SPDX-License-Identifier: BSD-3-Clause
"""story_picture.py PLUGIN MESH PICTURE : draws distances on the preview of a stream, with isolines.

The isolines are those of the whole mesh: the reader and the contour are asked for one piece after
the other, so that only a piece is in memory. For pvpython.
"""
import sys

from paraview.simple import *
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkContourFilter

PIECES = 256
BANDS = 24


def isolines(source, largest):
    """The isolines of all pieces."""
    algorithm = source.GetClientSideObject()
    contour = vtkContourFilter()
    contour.SetInputConnection(algorithm.GetOutputPort())
    contour.SetInputArrayToProcess(0, 0, 0, 0, "Distance")
    contour.GenerateValues(BANDS - 1, largest / BANDS, largest * (BANDS - 1) / BANDS)
    contour.ComputeScalarsOff()
    contour.ComputeNormalsOff()
    lines = vtkAppendPolyData()
    for piece in range(PIECES):
        contour.UpdatePiece(piece, PIECES, 0)
        part = vtkPolyData()
        part.SetPoints(contour.GetOutput().GetPoints())
        part.SetLines(contour.GetOutput().GetLines())
        if part.GetNumberOfCells():
            lines.AddInputData(part)
    lines.Update()
    return lines.GetOutput()


def main():
    plugin, mesh, picture = sys.argv[1:]
    LoadPlugin(plugin, ns=globals())
    source = StreamingMeshReader(FileName=mesh, PreviewPoints=1000000, MaximumPointsInMemory=0)
    source.UpdatePipeline()
    largest = source.PointData["Distance"].GetRange()[1]

    view = CreateRenderView()
    view.ViewSize = [1200, 1200]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    surface = Show(source, view)
    ColorBy(surface, ("POINTS", "Distance"))
    colours = GetColorTransferFunction("Distance")
    colours.ApplyPreset("Turbo", True)
    colours.RescaleTransferFunction(0.0, largest)
    surface.SetScalarBarVisibility(view, False)

    reader = StreamingMeshReader(FileName=mesh, MaximumPointsInMemory=2**31 - 1)
    lines = TrivialProducer()
    lines.GetClientSideObject().SetOutput(isolines(reader, largest))
    shown = Show(lines, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.05, 0.05, 0.1]
    shown.LineWidth = 2.0
    ResetCamera(view)
    Render(view)
    GetActiveCamera().Dolly(1.3)
    SaveScreenshot(picture, view, ImageResolution=[1200, 1200])


main()
