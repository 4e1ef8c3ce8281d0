# SPDX-License-Identifier: BSD-3-Clause
"""All processes deform together, each its own piece, with the result of the streaming engine."""

import json
import os
import sys

import deformation_testing as d
import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from streamingmultigrid.vtk import vtkStreamingMultigridFilters  # the methods of the filter

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
folder = t.make_shared_folder()


def deformed(proxy, engine):
    """Ids, points, normals and report of this process."""
    proxy.Engine = engine
    proxy.Tolerance = 1e-10
    proxy.MaximumCycles = 100
    proxy.UpdatePipeline()
    solver = t.client_object(proxy)
    assert solver.GetConverged() == 1, solver.GetOutcome()
    data = solver.GetOutputDataObject(0)
    report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
    if data.GetNumberOfPoints() == 0:
        return numpy.zeros(0, int), numpy.zeros((0, 3)), None, report
    assert not data.GetPointData().HasArray("HandleMask")
    normals = data.GetPointData().GetArray("Normals")
    return (t.vtk_to_numpy(data.GetPointData().GetGlobalIds()).copy(),
            t.vtk_to_numpy(data.GetPoints().GetData()).copy(),
            t.vtk_to_numpy(normals).copy() if normals else None, report)


def check_same(proxy, size):
    """Both engines move the points of this process equally, and have the same normals and notes."""
    ids, points, normals, report = deformed(proxy, "Distributed")
    parts = report["distributed"]
    assert parts["processes"] == ranks and parts["setups"] == 1 and len(parts["iterations"]) == 7
    streamed_ids, streamed, streamed_normals, streamed_report = deformed(proxy, "Streaming")
    assert "distributed" not in streamed_report and (ids == streamed_ids).all()
    for key in ("vertices", "cells", "prescribed", "shared", "components", "free_components"):
        assert report[key] == streamed_report[key], key
    assert report["notes"] == streamed_report["notes"], (report["notes"], streamed_report["notes"])
    assert len(ids) == 0 or abs(points - streamed).max() <= 1e-6 * size
    assert (normals is None) == (streamed_normals is None)
    assert normals is None or abs(normals - streamed_normals).max() <= 1e-4
    return ids, points, normals


# A surface with normals, which cross the borders of the pieces.
reader = OpenDataFile(t.BUNNY)
handles = d.make_handles(reader, MeshHandle)
deformation = StreamingMeshDeformation(Input=handles)
ids, points, _ = check_same(deformation, 0.2)
solver = t.client_object(deformation)
deformation.Engine = "Distributed"
deformation.UpdatePipeline()
assert f"iterations on {ranks} process" in solver.GetOutcome(), solver.GetOutcome()

# Automatic says what it chose; a given number of V-cycles is for the streaming engine.
notes = deformed(deformation, "Automatic")[3]["notes"]
if ranks > 1:
    assert "the distributed engine was chosen, since the estimate of" in " ".join(notes)
    deformation.Cycles = 2
    notes = deformed(deformation, "Automatic")[3]["notes"]
    assert "the streaming engine was chosen, since it counts V-cycles (Cycles)" in notes
    deformation.Cycles = 0

# The pieces of another filter, whose points are in no order.
other = StreamingMeshDeformation(
    Input=RedistributeDataSet(Input=handles, BoundaryMode="Assign to one region"))
other_ids, moved, _, report = deformed(other, "Distributed")
assert report["vertices"] == t.BUNNY_POINTS and report["cells"] == t.BUNNY_CELLS
known = numpy.full((t.BUNNY_POINTS, 3), numpy.nan)
known[ids] = points
both = ~numpy.isnan(known[other_ids, 0])
assert abs(moved[both] - known[other_ids][both]).max(initial=0) <= 1e-6 * 0.2

# A torus with normals in its file.
path = os.path.join(folder, "torus.ply")
if rank == 0:
    u, v = (a.ravel() for a in numpy.mgrid[0:40, 0:20])
    r = 2 + numpy.cos(v * numpy.pi / 10)
    places = numpy.stack([r * numpy.cos(u * numpy.pi / 20), r * numpy.sin(u * numpy.pi / 20),
                          numpy.sin(v * numpy.pi / 10)], 1)
    corners = numpy.stack([u * 20 + v, (u + 1) % 40 * 20 + v, (u + 1) % 40 * 20 + (v + 1) % 20,
                           u * 20 + (v + 1) % 20], 1)
    with open(path, "w") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 800\n")
        file.writelines(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        file.write("element face 800\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines("%g %g %g 0 0 1\n" % tuple(p) for p in places)
        file.writelines("4 %d %d %d %d\n" % tuple(c) for c in corners)
controller.Barrier()
fixed = MeshHandle(Input=StreamingMeshReader(FileName=path), RegionFunction="Plane", Motion="Fixed")
fixed.RegionFunction.Origin = [-1, 0, 0]
fixed.RegionFunction.Normal = [1, 0, 0]
turned = MeshHandle(Input=fixed, RegionFunction="Plane", Motion="Similarity")
turned.RegionFunction.Origin = [2, 0, 0]
turned.RegionFunction.Normal = [-1, 0, 0]
turned.RotationAxis, turned.RotationAngle, turned.Scale = [1, 1, 0], 60.0, 1.2
_, points, normals = check_same(StreamingMeshDeformation(Input=turned), 6.0)
assert len(points) == 0 or normals is not None

# A preview is deformed in memory, by process 0, as ever.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
deformation.Engine = "Distributed"
deformation.UpdatePipeline()
shown = t.client_object(deformation).GetOutputDataObject(0)
assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
assert shown.GetFieldData().GetArray("Preview").GetValue(0) == 1
controller.Barrier()
print("passed in process", rank)
