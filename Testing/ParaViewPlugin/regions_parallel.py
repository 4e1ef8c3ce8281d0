# SPDX-License-Identifier: BSD-3-Clause
"""Regions that extend across pieces, in several processes: each marks the points of its own piece."""

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
folder = t.make_shared_folder()


def marks(source, name):
    """The ids of the points of the piece and their marks, and which are its own: ParaView asks for ghost cells in
    parallel, which readers have, and other filters not."""
    points = t.client_object(source).GetOutputDataObject(0).GetPointData()
    own = t.vtk_to_numpy(points.GetArray("vtkGhostType")) & 1 == 0
    return t.vtk_to_numpy(points.GetGlobalIds()), t.vtk_to_numpy(points.GetArray(name)), own, points


def check(reader, **settings):
    region = MeshRegion(Input=reader, **settings)
    distance = StreamingDistance(Input=region)
    distance.UpdatePipeline()
    ids, mine, own, points = marks(distance, "RegionMask")
    assert ((t.vtk_to_numpy(points.GetArray("Distance")) == 0) == (mine == 1)).all(), (rank, settings)
    path = os.path.join(folder, "region.vsm")
    SaveData(path, proxy=region)
    controller.Barrier()
    written = OpenDataFile(path)
    written.UpdatePipeline()
    there, whole, of_file, _ = marks(written, "RegionMask")
    assert len(ids[own]) > 0 and (there[of_file] == ids[own]).all(), (rank, settings)
    marked = dict(zip(there, whole))
    assert [marked[number] for number in ids] == list(mine), (rank, settings)
    controller.Barrier()
    # The preview is in process 0.
    reader.MaximumPointsInMemory = 500
    region.UpdatePipeline()
    assert (t.client_object(region).GetOutputDataObject(0).GetNumberOfPoints() > 0) == (rank == 0)
    reader.MaximumPointsInMemory = 2000000


check(OpenDataFile(t.BUNNY), Region="Boundary")
sink = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "heat_sink.msh")
check(StreamingMeshReader(FileName=sink), Region="Tag", TagArray="PhysicalTag", Tag=1)
print("passed in process", rank)
