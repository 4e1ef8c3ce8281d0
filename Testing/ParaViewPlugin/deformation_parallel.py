# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the one deformed mesh; process 0 has the preview."""

import json
import os
import sys

import deformation_testing as d
import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from streamingmultigrid.vtk import vtkStreamingMultigridFilters, vtkStreamingMultigridIO

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1

reader = OpenDataFile(t.BUNNY)
handles = d.make_handles(reader, MeshHandle)
deformation = StreamingMeshDeformation(Input=handles)
deformation.UpdatePipeline()
data = t.client_object(deformation).GetOutputDataObject(0)
first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds()).copy()
positions = t.vtk_to_numpy(data.GetPoints().GetData()).copy()
report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
assert report["converged"] and report["vertices"] == t.BUNNY_POINTS

# The writer streams in process 0 while the others wait; its output contains every piece.
path = os.path.join(t.make_shared_folder(), "deformation.vsm")
SaveData(path, proxy=deformation)
controller.Barrier()
alone = vtkStreamingMultigridIO.vtkStreamingMeshReader()
alone.SetFileName(path)
alone.Update()
whole = t.vtk_to_numpy(alone.GetOutputDataObject(0).GetPoints().GetData())
assert whole.shape == (t.BUNNY_POINTS, 3)
assert (positions == whole[ids]).all()

# A second deformation streams from the first one in process 0; each stays correct when updated
# again.
second = MeshHandle(Input=deformation, RegionFunction="Plane", Motion="Fixed")
second.RegionFunction.Origin = [0, t.FEET, 0]
second.RegionFunction.Normal = [0, 1, 0]
top = MeshHandle(Input=second, RegionFunction="Plane", Motion="Similarity", Translation=[0, 0, 0.01])
top.RegionFunction.Origin = [0, 0.15, 0]
top.RegionFunction.Normal = [0, -1, 0]
chained = StreamingMeshDeformation(Input=top)
for shift in (0.01, 0.02):
    top.Translation = [0, 0, shift]
    chained.UpdatePipeline()
    result = t.client_object(chained).GetOutputDataObject(0)
    moved = t.vtk_to_numpy(result.GetPoints().GetData())
    high = positions[:, 1] > 0.15
    assert (abs(moved[high] - positions[high] - [0, 0, shift]) < 1e-6).all()
    # Process 0 is the only one that has lost its piece by streaming.
    t.client_object(deformation).UpdatePiece(rank, ranks, 0)
    again = t.client_object(deformation).GetOutputDataObject(0)
    assert (t.vtk_to_numpy(again.GetPoints().GetData()) == positions).all()

# All of the preview is in process 0, which deforms it alone.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
for angle in (30.0, 20.0):
    handles.RotationAngle = angle
    deformation.UpdatePipeline()
    shown = t.client_object(deformation).GetOutputDataObject(0)
    assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
    assert shown.GetFieldData().GetArray("Preview").GetValue(0) == 1
    assert t.client_object(deformation).GetNumberOfBuilds() == (1 if rank == 0 else 0), rank

# A preview that a filter makes is in process 0, too.
preview = StreamingMeshPreview(Input=deformation, PreviewPoints=2000)
preview.UpdatePipeline()
assert (t.client_object(preview).GetOutput().GetNumberOfPoints() > 0) == (rank == 0), rank

# So is a simplified mesh, which process 0 makes of the streamed pieces.
simplified = StreamingMeshSimplification(Input=deformation, NumberOfVertices=2000)
simplified.UpdatePipeline()
assert (t.client_object(simplified).GetOutput().GetNumberOfPoints() > 0) == (rank == 0), rank
controller.Barrier()
print("passed in process", rank)
