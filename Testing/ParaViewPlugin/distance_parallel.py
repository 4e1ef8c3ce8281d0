# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the mesh with the distances of one process alone."""

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
FROM = '[{"vertices": [100]}, {"nearest": [[-0.0175, 0.187, -0.02]]}]'

reader = OpenDataFile(t.BUNNY)
distance = StreamingDistance(Input=reader, From=FROM, Source=1, Direction=1)
alone = vtkStreamingMultigridFilters.vtkStreamingDistance()
alone.SetController(None)
mesh = vtkStreamingMultigridIO.vtkStreamingMeshReader()
mesh.SetFileName(t.BUNNY)
alone.SetInputConnection(mesh.GetOutputPort())
alone.SetFrom(FROM)
alone.SourceOn()
alone.DirectionOn()

distance.UpdatePipeline()
data = t.client_object(distance).GetOutputDataObject(0)
first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
assert report["converged"] and report["vertices"] == t.BUNNY_POINTS
assert report["distance"]["sources"] == 2, report
alone.Update()
whole = alone.GetOutputDataObject(0).GetPointData()
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
for name in ("Distance", "DistanceSource", "DistanceDirection"):
    values = t.vtk_to_numpy(data.GetPointData().GetArray(name))
    assert (values == t.vtk_to_numpy(whole.GetArray(name))[ids]).all(), (rank, name)
    assert values.max() > values.min() or name == "DistanceSource", (rank, name)

# All of the preview is in process 0, which measures on it alone.
distance.From = '{"nearest": [[-0.0175, 0.187, -0.02]]}'
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
distance.UpdatePipeline()
shown = t.client_object(distance).GetOutputDataObject(0)
assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
controller.Barrier()
print("passed in process", rank)
