# SPDX-License-Identifier: BSD-3-Clause
"""Several processes: each has its own piece of the one solution."""

import json
import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController, vtkPlane
from streamingmultigrid.vtk import vtkStreamingMultigridFilters, vtkStreamingMultigridIO

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1

reader = OpenDataFile(t.BUNNY)
poisson = t.make_poisson(t.make_problem(reader))
poisson.UpdatePipeline()
data = t.client_object(poisson).GetOutputDataObject(0)
first, last = t.BUNNY_CELLS * rank // ranks, t.BUNNY_CELLS * (rank + 1) // ranks
assert data.GetNumberOfCells() == last - first, (rank, data.GetNumberOfCells())
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
values = t.vtk_to_numpy(data.GetPointData().GetArray("Solution"))
own = t.vtk_to_numpy(data.GetPointData().GetArray("vtkGhostType")) == 0
report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
assert report["converged"] and report["vertices"] == t.BUNNY_POINTS

# The same problem by this process alone.
alone = vtkStreamingMultigridIO.vtkStreamingMeshReader()
alone.SetFileName(t.BUNNY)
algorithms = [alone]
for proxy in (poisson.Input.Input, poisson.Input):
    calculator = t.client_object(proxy).NewInstance()
    calculator.SetInputConnection(algorithms[-1].GetOutputPort())
    calculator.SetFunction(proxy.Function)
    calculator.SetResultArrayName(proxy.ResultArrayName)
    for axis, name in enumerate(("coordsX", "coordsY", "coordsZ")):
        calculator.AddCoordinateScalarVariable(name, axis)
    calculator.AddCoordinateVectorVariable("coords", 0, 1, 2)
    algorithms.append(calculator)
solver = vtkStreamingMultigridFilters.vtkStreamingPoisson()
solver.SetController(None)
solver.SetInputConnection(algorithms[-1].GetOutputPort())
for index, name in ((0, "Mask"), (1, "Values"), (3, "Values")):
    solver.SetInputArrayToProcess(index, 0, 0, 0, name)
solver.Update()
whole = t.vtk_to_numpy(solver.GetOutputDataObject(0).GetPointData().GetArray("Solution"))
assert whole.shape == (t.BUNNY_POINTS, 3)
assert (values == whole[ids]).all()

# A second request does not solve again; a change does, in all processes.
poisson.UpdatePipeline()
poisson.Weights = "Uniform"
poisson.UpdatePipeline()
data = t.client_object(poisson).GetOutputDataObject(0)
assert (t.vtk_to_numpy(data.GetPointData().GetArray("Solution")) != values).any()

# The writer streams in process 0 while the others wait.
path = os.path.join(t.make_shared_folder(), "parallel.vsm")
SaveData(path, proxy=poisson)
written = OpenDataFile(path)
written.UpdatePipeline()
written.UpdatePropertyInformation()
assert written.GetPropertyValue("FullNumberOfPoints") == t.BUNNY_POINTS

# Conditions, and the fluxes of each process's own cells.
ENDS = ((t.FEET, 1.0, 0.0), (t.EARS, -1.0, 1.0))
chain, last_alone = reader, alone
for height, normal, value in ENDS:
    chain = MeshCondition(Input=chain, RegionFunction="Plane", Value=value)
    chain.RegionFunction.Origin, chain.RegionFunction.Normal = [0, height, 0], [0, normal, 0]
    plane = vtkPlane()
    plane.SetOrigin(0, height, 0)
    plane.SetNormal(0, normal, 0)
    condition = vtkStreamingMultigridFilters.vtkMeshCondition()
    condition.SetInputConnection(last_alone.GetOutputPort())
    condition.SetRegionFunction(plane)
    condition.SetValue(value)
    algorithms.append(condition)
    last_alone = condition
field = StreamingPoisson(Input=chain, Flux=1, Conductivity=3)
field.UpdatePipeline()
data = t.client_object(field).GetOutputDataObject(0)
solver = vtkStreamingMultigridFilters.vtkStreamingPoisson()
solver.SetController(None)
solver.SetInputConnection(last_alone.GetOutputPort())
solver.SetConductivity(3)
solver.SetFlux(True)
solver.Update()
whole = solver.GetOutputDataObject(0)
values = t.vtk_to_numpy(data.GetPointData().GetArray("Solution"))
assert values.min() >= -0.05 and values.max() <= 1.05
assert (values == t.vtk_to_numpy(whole.GetPointData().GetArray("Solution"))[ids]).all()
flux = t.vtk_to_numpy(data.GetCellData().GetArray("Flux"))
assert (flux == t.vtk_to_numpy(whole.GetCellData().GetArray("Flux"))[first:last]).all()
controller.Barrier()
print("passed in process", rank)
