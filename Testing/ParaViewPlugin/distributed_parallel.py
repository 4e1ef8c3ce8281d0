# SPDX-License-Identifier: BSD-3-Clause
"""All processes solve together, each for its own piece, with the result of the streaming engine."""

import json
import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController
from paraview.vtk.util.numpy_support import numpy_to_vtk
from streamingmultigrid.vtk import vtkStreamingMultigridFilters  # the methods of the filter

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
folder = t.make_shared_folder()


def solved(proxy, engine, cells=None):
    """Ids, solution, a cell array and report of this process."""
    proxy.Engine = engine
    proxy.Tolerance = 1e-10
    proxy.MaximumCycles = 100
    proxy.UpdatePipeline()
    solver = t.client_object(proxy)
    assert solver.GetConverged() == 1, solver.GetOutcome()
    data = solver.GetOutputDataObject(0)
    report = json.loads(data.GetFieldData().GetAbstractArray("Report").GetValue(0))
    if data.GetNumberOfPoints() == 0:
        return numpy.zeros(0, int), numpy.zeros((0, 1)), None, report
    points = data.GetPointData()
    values = t.vtk_to_numpy(points.GetArray("Solution")).reshape(data.GetNumberOfPoints(), -1).copy()
    array = t.vtk_to_numpy(data.GetCellData().GetArray(cells)).copy() if cells else None
    return t.vtk_to_numpy(points.GetGlobalIds()).copy(), values, array, report


def check_report(report, columns):
    parts = report["distributed"]
    assert parts["processes"] == ranks
    assert len(parts["iterations"]) == columns and min(parts["iterations"]) > 0
    assert len(parts["rss_bytes_peak"]) == ranks and min(parts["rss_bytes_peak"]) > 1e6
    assert sum(parts["iterations"]) == report["cycles"]


def check_results(report, streamed):
    """The results of both engines agree within 1e-6 of the largest of a kind, or of the energy."""
    assert len(report["conditions"]) == len(streamed["conditions"]) > 0
    both = tuple((
        [condition["flux"] for condition in r["conditions"]], r["energy"], r["mean"], r["source"],
        [[condition["area"], condition["vertices"]] for condition in r["conditions"]],
        [extreme["value"] for extreme in r["minimum"] + r["maximum"]]) for r in (report, streamed))
    for a, b in zip(*both):
        scale = max(numpy.abs(b).max(), max(streamed["energy"]))
        assert numpy.abs(numpy.subtract(a, b)).max() <= 1e-6 * scale, (a, b)


def check_same(proxy, columns, cells=None):
    """Both engines have the same solution at the points of this process."""
    ids, values, array, report = solved(proxy, "Distributed", cells)
    check_report(report, columns)
    streamed_ids, streamed, streamed_array, streamed_report = solved(proxy, "Streaming", cells)
    assert "distributed" not in streamed_report
    check_results(report, streamed_report)
    assert (ids == streamed_ids).all()
    if len(ids) > 0:
        assert abs(values - streamed).max() <= 1e-6 * numpy.ptp(streamed)
        assert array is None or abs(array - streamed_array).max() <= 1e-6 * abs(streamed_array).max()
    return values


# Three right-hand sides on a surface.
reader = OpenDataFile(t.BUNNY)
problem = t.make_problem(reader)
poisson = t.make_poisson(problem)
first = check_same(poisson, 3)
report = solved(poisson, "Distributed")[3]
solver = t.client_object(poisson)
assert f"iterations on {ranks} process" in solver.GetOutcome(), solver.GetOutcome()
# A second request does not solve again; a change does.
assert solved(poisson, "Distributed")[3] == report
poisson.Weights = "Uniform"
uniform = check_same(poisson, 3)
assert len(first) == 0 or (uniform != first).any()
poisson.Weights = "Cotangent"

# Automatic says what it chose.
report = solved(poisson, "Automatic")[3]
if ranks > 1:
    assert "the distributed engine was chosen, since the estimate of" in " ".join(report["notes"])
    check_report(report, 3)
else:
    assert "the streaming engine was chosen, since there is one process" in report["notes"]

# The writer streams in process 0 alone.
path = os.path.join(folder, "written.vsm")
SaveData(path, proxy=poisson)
written = OpenDataFile(path)
written.UpdatePipeline()
written.UpdatePropertyInformation()
assert written.GetPropertyValue("FullNumberOfPoints") == t.BUNNY_POINTS

# The whole solution in each process, for comparisons by id.
ids, values = solved(poisson, "Streaming")[:2]
whole = numpy.full((t.BUNNY_POINTS, 3), -1e30)
whole[ids] = values
parts = numpy_to_vtk(whole.ravel())
largest = numpy_to_vtk(numpy.zeros(parts.GetNumberOfTuples()))
controller.AllReduce(parts, largest, 0)  # vtkCommunicator::MAX_OP
whole = t.vtk_to_numpy(largest).reshape(-1, 3)

# A partition by another filter, whose points are in no order.
other = t.make_poisson(RedistributeDataSet(Input=problem, BoundaryMode="Assign to one region"))
ids, values, _, report = solved(other, "Distributed")
assert report["vertices"] == t.BUNNY_POINTS and report["cells"] == t.BUNNY_CELLS
assert len(ids) > 0 and abs(values - whole[ids]).max() <= 1e-6 * numpy.ptp(whole)

# A solid with conditions, and the fluxes of each process's own cells.
sink = StreamingMeshReader(
    FileName=os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "heat_sink.msh"))
text = {"dirichlet": [{"halfspace": [0, 0, -1, -0.0001], "value": 0}],
        "robin": [{"halfspace": [0, 0, 1, 0.005], "coefficient": 2, "ambient": 1}],
        "flux": [{"halfspace": [-1, 0, 0, -0.011], "value": 3}],
        "conductivity": [3, 2, 1, 0.5, 0, 0]}
heat = StreamingPoisson(Input=sink, Flux=1, Problem=json.dumps(text))
check_same(heat, 1, "Flux")

# Three cells: processes have none.
path = os.path.join(folder, "strip.obj")
if rank == 0:
    with open(path, "w") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\nf 2 4 3\nf 3 4 5\n")
controller.Barrier()
strip = StreamingMeshReader(FileName=path)
text = {"source": 2, "dirichlet": [{"halfspace": [0, -1, 0, -0.1], "value": 0}]}
check_same(StreamingPoisson(Input=strip, Problem=json.dumps(text)), 1)
controller.Barrier()
print("passed in process", rank)
