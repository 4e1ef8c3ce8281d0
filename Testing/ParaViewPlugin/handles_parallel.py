# SPDX-License-Identifier: BSD-3-Clause
"""Mesh handles in several processes: each holds the points of its own piece."""

import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1


def held(handle):
    """The ids of the own points of the piece, and which of them are held."""
    handle.UpdatePipeline()
    data = t.client_object(handle).GetOutputDataObject(0)
    points = data.GetPointData()
    own = t.vtk_to_numpy(points.GetArray("vtkGhostType")) == 0
    ids = t.vtk_to_numpy(points.GetGlobalIds())
    mask = t.vtk_to_numpy(points.GetArray("HandleMask"))
    return ids.copy(), ids[own], ids[own & (mask > 0)]


def united(ids):
    """The ids of all processes."""
    from paraview.vtk import vtkIdTypeArray
    from paraview.vtk.util.numpy_support import numpy_to_vtkIdTypeArray

    whole = vtkIdTypeArray()
    controller.AllGatherV(numpy_to_vtkIdTypeArray(numpy.array(ids, dtype=numpy.int64), deep=1), whole)
    return sorted(t.vtk_to_numpy(whole)) if whole.GetNumberOfTuples() else []


reader = OpenDataFile(t.BUNNY)
handle = MeshHandle(Input=reader)
handle.RegionFunction.Radius = 0.05
ids, own, mine = held(handle)
assert len(united(own)) == t.BUNNY_POINTS and len(united(mine)) > 100

# Indices refer to the piece of the process that is given with them.
handle.Region = "Selection"
handle.Selection = IDSelectionSource(IDs=[0, 2000, 1, 3000], FieldType="POINT")
expected = [ids[2000 + 1000 * rank]] if rank < 2 else []
assert list(held(handle)[2]) == [i for i in expected if i in own]

# Ids, points and their surroundings extend across pieces.
handle.Region = "Ids"
handle.Ids = [5, 30000]
assert united(held(handle)[2]) == [5, 30000]
handle.Rings = 3
around = united(held(handle)[2])
path = os.path.join(t.make_shared_folder(), "handles.vsm")
SaveData(path, proxy=handle)
controller.Barrier()
written = OpenDataFile(path)
written.UpdatePipeline()
data = t.client_object(written).GetOutputDataObject(0)
mask = t.vtk_to_numpy(data.GetPointData().GetArray("HandleMask"))
own = t.vtk_to_numpy(data.GetPointData().GetArray("vtkGhostType")) == 0
streamed = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())[own & (mask > 0)]
assert united(streamed) == around and 50 < len(around) < 100, len(around)
handle.Region = "Points"
handle.Points = [0, 0, 0]
handle.Rings = 0
assert len(united(held(handle)[2])) == 1

controller.Barrier()

# The preview is in process 0, where it is selected.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
handle.Region = "Selection"
handle.Selection = IDSelectionSource(IDs=[0, 7, 0, 8], FieldType="POINT")
handle.UpdatePipeline()
shown = t.client_object(handle).GetOutputDataObject(0)
if rank == 0:
    mask = t.vtk_to_numpy(shown.GetPointData().GetArray("HandleMask"))
    assert list(numpy.flatnonzero(mask)) == [7, 8]
SaveData(path, proxy=handle)
controller.Barrier()
reader = OpenDataFile(path)
reader.UpdatePipeline()
data = t.client_object(reader).GetOutputDataObject(0)
mask = t.vtk_to_numpy(data.GetPointData().GetArray("HandleMask"))
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
assert len(set(united(ids[mask > 0]))) > 2
controller.Barrier()
print("passed in process", rank)
