# SPDX-License-Identifier: BSD-3-Clause
"""The distributed engine on meshes that other filters have partitioned: with the ids of Generate Global
Ids, in no order of the stream, and with ghost cells."""

import json
import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from paraview.vtk.util.numpy_support import numpy_to_vtk
from paraview.vtk.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
from streamingmultigrid.vtk import vtkStreamingMultigridFilters  # the methods of the filter
from streamingmultigrid.vtk import vtkStreamingMeshReader

LoadPlugin(sys.argv[1], ns=globals())

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1
folder = t.make_shared_folder()
HEAT_SINK = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "heat_sink.msh")
BUNNY = {"source": 1, "dirichlet": [{"halfspace": [0, -1, 0, -t.FEET], "value": 2}],
         "flux": [{"halfspace": [0, 1, 0, t.EARS], "value": 3}]}
SINK = {"dirichlet": [{"halfspace": [0, 0, -1, -0.0001], "value": 0}], "conductivity": [3, 2, 1, 0.5, 0, 0],
        "robin": [{"halfspace": [0, 0, 1, 0.005], "coefficient": 2, "ambient": 1}],
        "flux": [{"halfspace": [-1, 0, 0, -0.011], "value": 3}]}


def foreign_file(file):
    """The mesh as any program would write it, without ids; Number is the place in the stream."""
    reader = vtkStreamingMeshReader()
    reader.SetFileName(file)
    reader.Update()
    mesh = reader.GetOutputDataObject(0)
    plain = mesh.NewInstance()
    plain.CopyStructure(mesh)
    number = numpy_to_vtk(t.vtk_to_numpy(mesh.GetPointData().GetGlobalIds()).astype(float), deep=True)
    number.SetName("Number")
    plain.GetPointData().AddArray(number)
    isSurface = mesh.IsA("vtkPolyData")
    writer = vtkXMLPolyDataWriter() if isSurface else vtkXMLUnstructuredGridWriter()
    path = os.path.join(folder, "foreign" + (".vtp" if isSurface else ".vtu"))
    if rank == 0:
        writer.SetFileName(path)
        writer.SetInputData(plain)
        assert writer.Write() == 1
    controller.Barrier()
    return path


def solve(source, problem, engine):
    """The filter on this process, its output and its report."""
    poisson = StreamingPoisson(Input=source, Engine=engine, Problem=json.dumps(problem),
                               Tolerance=1e-10, MaximumCycles=100)
    poisson.UpdatePipeline()
    solver = t.client_object(poisson)
    assert solver.GetConverged() == 1, solver.GetOutcome()
    data = solver.GetOutputDataObject(0)
    report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
    return data, report


def values_of(data):
    return t.vtk_to_numpy(data.GetPointData().GetArray("Solution")).copy()


def whole_solution(reader, problem):
    """The solution of the streaming engine by place in the stream, and its report."""
    data, report = solve(reader, problem, "Streaming")
    whole = numpy.full(report["vertices"], -1e30)
    if data.GetNumberOfPoints() > 0:
        whole[t.vtk_to_numpy(data.GetPointData().GetGlobalIds())] = values_of(data)
    parts, largest = numpy_to_vtk(whole), numpy_to_vtk(numpy.zeros(len(whole)))
    controller.AllReduce(parts, largest, 0)  # vtkCommunicator::MAX_OP
    return t.vtk_to_numpy(largest).copy(), report


def check(source, problem, expected, number, figures):
    """The distributed engine has the expected solution at the points of this process."""
    data, report = solve(source, problem, "Distributed")
    assert report["distributed"]["processes"] == ranks
    for key in "vertices", "cells", "prescribed":
        assert report[key] == figures[key], (key, report[key], figures[key])
    places = t.vtk_to_numpy(data.GetPointData().GetArray(number)).astype(int)
    assert len(places) > 0
    error = abs(values_of(data) - expected[places]).max()
    assert error <= 1e-6 * numpy.ptp(expected), error
    return data


for file, problem in (t.BUNNY, BUNNY), (HEAT_SINK, SINK):
    reader = StreamingMeshReader(FileName=file)
    expected, figures = whole_solution(reader, problem)

    # One file in pieces by Redistribute DataSet, with other ids.
    pieces = RedistributeDataSet(Input=OpenDataFile(foreign_file(file)),
                                 BoundaryMode="Assign to one region")
    check(GenerateGlobalIds(Input=pieces), problem, expected, "Number", figures)

    # Pieces that ParaView has written, without ids.
    if file == t.BUNNY:
        pieces = ExtractSurface(Input=pieces)  # polygons, which Redistribute DataSet makes cells of a grid
    path = os.path.join(folder, "pieces.pvtp" if file == t.BUNNY else "pieces.pvtu")
    SaveData(path, proxy=pieces)
    controller.Barrier()
    check(GenerateGlobalIds(Input=OpenDataFile(path)), problem, expected, "Number", figures)

    # Cells of the neighbours, which are marked.
    ghosts = GhostCellsGenerator(Input=reader, BuildIfRequired=0)
    data = check(ghosts, problem, expected, "GlobalIds", figures)
    marks = t.vtk_to_numpy(data.GetCellData().GetArray("vtkGhostType"))
    assert (marks & 1).any() and not (marks & 1).all()
controller.Barrier()
print("passed in process", rank)
