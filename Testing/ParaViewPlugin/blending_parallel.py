# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the one blended mesh, the bits of one process alone."""

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
blend = StreamingBlend(Input=t.make_scans(reader), Patch="Scan", Columns=["Light"])
# The same by filters of VTK in this process alone.
mesh = vtkStreamingMultigridIO.vtkStreamingMeshReader()
mesh.SetFileName(t.BUNNY)
light = t.make_vtk_scans(mesh)
alone = vtkStreamingMultigridFilters.vtkStreamingBlend()
alone.SetController(None)
alone.SetInputConnection(light.GetOutputPort())
alone.SetPatch("Scan")
alone.AddColumn("Light")
alone.Update()
whole = alone.GetOutputDataObject(0)
assert whole.GetNumberOfPoints() == t.BUNNY_POINTS
light.Update()
values = lambda data: t.vtk_to_numpy(data.GetPointData().GetArray("Light"))
assert (values(whole) != values(light.GetOutputDataObject(0))).any()

blend.UpdatePipeline()
data = t.client_object(blend).GetOutputDataObject(0)
first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
assert report["converged"] and report["vertices"] == t.BUNNY_POINTS
assert report["seams"][0]["after"] < 0.1 * report["seams"][0]["before"], report["seams"]
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
assert (values(data) == values(whole)[ids]).all(), rank

# All of the preview is in process 0, which blends it alone.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
blend.UpdatePipeline()
shown = t.client_object(blend).GetOutputDataObject(0)
assert (shown.GetNumberOfPoints() > 0) == (rank == 0), rank
controller.Barrier()
print("passed in process", rank)
