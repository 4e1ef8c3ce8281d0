# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the one smoothed mesh, the bits of one process alone."""

import json
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from streamingmultigrid import vtkStreamingMultigridFilters, vtkStreamingMultigridIO

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1

reader = OpenDataFile(t.BUNNY)
smoothing = StreamingMeshSmoothing(Input=t.make_scans(reader), Size=8, Steps=2)
alone = vtkStreamingMultigridFilters.vtkStreamingMeshSmoothing()
alone.SetController(None)
mesh = vtkStreamingMultigridIO.vtkStreamingMeshReader()
mesh.SetFileName(t.BUNNY)
light = t.make_vtk_scans(mesh)
alone.SetInputConnection(light.GetOutputPort())
alone.SetSize(8)
alone.SetSteps(2)


def compare(array=None):
    """The piece of this process with that of the mesh smoothed by it alone."""
    smoothing.UpdatePipeline()
    data = t.client_object(smoothing).GetOutputDataObject(0)
    first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
    assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
    report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
    assert report["converged"] and report["vertices"] == t.BUNNY_POINTS
    assert len(report["steps"]) == 2, report
    alone.Update()
    whole = alone.GetOutputDataObject(0)
    assert whole.GetNumberOfPoints() == t.BUNNY_POINTS
    ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
    values = lambda mesh: t.vtk_to_numpy(mesh.GetPointData().GetArray(array) if array
                                         else mesh.GetPoints().GetData())
    assert (values(data) == values(whole)[ids]).all(), (rank, array)
    light.Update()
    assert (values(data) != values(light.GetOutputDataObject(0))[ids]).any(), (rank, array)


compare()
# An array instead of the points.
smoothing.Array = "Light"
alone.SetArray("Light")
compare("Light")

# All of the preview is in process 0, which smooths it alone.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
smoothing.UpdatePipeline()
shown = t.client_object(smoothing).GetOutputDataObject(0)
assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
controller.Barrier()
print("passed in process", rank)
