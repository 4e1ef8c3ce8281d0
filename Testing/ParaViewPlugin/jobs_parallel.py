# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the one smoothed, blended or measured mesh, the bits of one
process alone."""

import json
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from streamingmultigrid.vtk import vtkStreamingMultigridFilters as filters
from streamingmultigrid.vtk import vtkStreamingMultigridIO

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1
EAR = '{"nearest": [[-0.0175, 0.187, -0.02]]}'

reader = OpenDataFile(t.BUNNY)
scans = t.make_scans(reader)
# The same mesh by classes of VTK, in this process alone.
mesh = vtkStreamingMultigridIO.vtkStreamingMeshReader()
mesh.SetFileName(t.BUNNY)
light = t.make_vtk_scans(mesh)


def values(data, array):
    """The bits of an array of the points, or of the points themselves."""
    return t.vtk_to_numpy(data.GetPointData().GetArray(array) if array else data.GetPoints().GetData())


def check(proxy, alone, *arrays):
    """The piece of this process with that of the whole mesh; returns the report."""
    alone.SetController(None)
    alone.SetInputConnection(light.GetOutputPort())
    proxy.UpdatePipeline()
    alone.Update()
    data, whole = t.client_object(proxy).GetOutputDataObject(0), alone.GetOutputDataObject(0)
    first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
    assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
    assert whole.GetNumberOfPoints() == t.BUNNY_POINTS
    report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
    assert report["converged"] and report["vertices"] == t.BUNNY_POINTS
    ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
    light.Update()
    before = light.GetOutputDataObject(0)
    for array in arrays:
        found = values(data, array)
        assert (found == values(whole, array)[ids]).all(), (rank, array)
        if array is None or before.GetPointData().HasArray(array):
            assert (found != values(before, array)[ids]).any(), (rank, array)
    return report


def check_preview(proxy):
    """All of the preview is in process 0, which works on it alone."""
    reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
    proxy.UpdatePipeline()
    shown = t.client_object(proxy).GetOutputDataObject(0)
    assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
    reader.MaximumPointsInMemory = 2000000


smoothing, alone = StreamingMeshSmoothing(Input=scans, Size=8, Steps=2), filters.vtkStreamingMeshSmoothing()
alone.SetSize(8)
alone.SetSteps(2)
assert len(check(smoothing, alone, None)["steps"]) == 2
# An array instead of the points.
smoothing.Array = "Light"
alone.SetArray("Light")
check(smoothing, alone, "Light")
check_preview(smoothing)

blend, alone = StreamingBlend(Input=scans, Patch="Scan", Columns=["Light"]), filters.vtkStreamingBlend()
alone.SetPatch("Scan")
alone.AddColumn("Light")
seam, = check(blend, alone, "Light")["seams"]
assert seam["after"] < 0.1 * seam["before"], seam
check_preview(blend)

places = f'[{{"vertices": [100]}}, {EAR}]'
distance, alone = StreamingDistance(Input=scans, From=places, Source=1, Direction=1), filters.vtkStreamingDistance()
alone.SetFrom(places)
alone.SourceOn()
alone.DirectionOn()
report_of_distance = check(distance, alone, "Distance", "DistanceSource", "DistanceDirection")
assert report_of_distance["distance"]["sources"] == 2, report_of_distance
distance.From = EAR
check_preview(distance)
controller.Barrier()
print("passed in process", rank)
