# SPDX-License-Identifier: BSD-3-Clause
"""The pieces of the solution: their union is the mesh; the numbers are those of the program smg."""

import json
import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

folder = t.make_folder()
container = os.path.join(folder, "bunny.vsm")
solved = os.path.join(folder, "solved.vsm")
problem = os.path.join(folder, "problem.json")
t.run_smg("convert", t.BUNNY, container, "--order", "keep")
with open(problem, "w", encoding="utf-8") as file:
    json.dump({"weights": "cotangent", "columns": 3, "dirichlet": [
        {"halfspace": [0, -1, 0, -t.FEET], "value": "position"},
        {"halfspace": [0, 1, 0, t.EARS], "value": "position"}]}, file)
t.run_smg("solve", container, solved, "--problem", problem)

reader = OpenDataFile(container)
poisson = t.make_poisson(t.make_problem(reader))
poisson.UpdatePipeline()
algorithm = t.client_object(poisson)
expected = OpenDataFile(solved)
expected.UpdatePipeline()
whole = t.pull(t.client_object(expected), 1, "Solution")[0]

for pieces in (1, 2, 7, 64):
    parts = t.pull(algorithm, pieces, "Solution")
    ids = numpy.concatenate([p[0][p[1]] for p in parts])
    assert (numpy.sort(ids) == numpy.arange(t.BUNNY_POINTS)).all(), pieces
    order = numpy.argsort(ids)
    for k in (2, 3):
        united = numpy.concatenate([p[k][p[1]] for p in parts])[order]
        assert (united == whole[k]).all(), (pieces, k, abs(united - whole[k]).max())
    assert (numpy.concatenate([p[4] for p in parts]) == whole[4]).all(), pieces

# One solve was enough for all of them.
poisson.UpdatePropertyInformation()
report = json.loads(poisson.GetPropertyValue("Report"))
assert report["vertices"] == t.BUNNY_POINTS and report["cells"] == t.BUNNY_CELLS
assert report["converged"] and poisson.GetPropertyValue("Converged") == 1
assert report["passes"] == report["cycles"] + 1 == poisson.GetPropertyValue("Passes")

# Likewise the smoothed mesh; a request for all of it is answered in memory.
smooth = os.path.join(folder, "smooth.vsm")
t.run_smg("smooth", container, smooth, "--size", "8edges", "--steps", 2)
smoothing = StreamingMeshSmoothing(Input=reader, Size=8, Steps=2)
smoothing.UpdatePipeline()
expected = OpenDataFile(smooth)
expected.UpdatePipeline()
smooth = t.pull(t.client_object(expected), 1)[0]
assert (smooth[2] != whole[2]).any()
for pieces in (1, 7, 64):
    parts = t.pull(t.client_object(smoothing), pieces)
    ids = numpy.concatenate([p[0] for p in parts])
    assert (numpy.concatenate([p[2] for p in parts]) == smooth[2][ids]).all(), pieces
    own = numpy.concatenate([p[0][p[1]] for p in parts])
    assert (numpy.sort(own) == numpy.arange(t.BUNNY_POINTS)).all(), pieces
    assert (numpy.concatenate([p[4] for p in parts]) == smooth[4]).all(), pieces

# Likewise the distances.
measured = os.path.join(folder, "measured.vsm")
t.run_smg("distance", container, measured, "--from", '{"vertices": [100]}')
distance = StreamingDistance(Input=reader, From='{"vertices": [100]}')
distance.UpdatePipeline()
expected = OpenDataFile(measured)
expected.UpdatePipeline()
measured = t.pull(t.client_object(expected), 1, "Distance")[0]
assert measured[3].max() > 0.1
for pieces in (1, 7, 64):
    parts = t.pull(t.client_object(distance), pieces, "Distance")
    own = numpy.concatenate([p[0][p[1]] for p in parts])
    assert (numpy.sort(own) == numpy.arange(t.BUNNY_POINTS)).all(), pieces
    for p in parts:
        assert (p[3] == measured[3][p[0]]).all(), pieces

# Likewise the blended mesh.
scans, blended = (os.path.join(folder, name) for name in ("scans.vsm", "blended.vsm"))
SaveData(scans, t.make_scans(reader))
t.run_smg("blend", scans, blended, "--patch", "Scan", "--columns", "Light")
expected = OpenDataFile(blended)
expected.UpdatePipeline()
light = t.pull(t.client_object(expected), 1, "Light")[0][3]
recorded = OpenDataFile(scans)
recorded.UpdatePipeline()
assert (light != t.pull(t.client_object(recorded), 1, "Light")[0][3]).any()
blend = StreamingBlend(Input=recorded, Patch="Scan", Columns=["Light"])
blend.UpdatePipeline()
for pieces in (1, 7, 64):
    parts = t.pull(t.client_object(blend), pieces, "Light")
    ids = numpy.concatenate([p[0] for p in parts])
    assert (numpy.concatenate([p[3] for p in parts]) == light[ids]).all(), pieces
    own = numpy.concatenate([p[0][p[1]] for p in parts])
    assert (numpy.sort(own) == numpy.arange(t.BUNNY_POINTS)).all(), pieces

# With the guard, the whole mesh is a preview; Outcome and the text for the view say where the solve was.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
for place, words in (("Full Mesh", "On the full mesh of 34,834 points."), ("Automatic", "On the full mesh of"),
                     ("Preview", "On the preview only: ")):
    poisson.Solve = place
    poisson.UpdatePipeline()
    preview = t.servermanager.Fetch(poisson)
    assert preview.GetFieldData().GetArray("Preview").GetValue(0) == 1
    assert preview.GetFieldData().GetArray("FullNumberOfPoints").GetValue(0) == t.BUNNY_POINTS
    poisson.UpdatePropertyInformation()
    outcome = poisson.GetPropertyValue("Outcome")
    text = t.servermanager.Fetch(poisson, idx=2).GetColumn(0).GetValue(0).replace("\n", " ")
    assert outcome.startswith(text) and text.startswith(words), (outcome, text)
    passes = t.servermanager.Fetch(poisson, idx=1)
    assert passes.GetNumberOfRows() == poisson.GetPropertyValue("Passes")
    ids = t.vtk_to_numpy(preview.GetPointData().GetGlobalIds())
    assert 100 < len(ids) <= 10000
    values = t.vtk_to_numpy(preview.GetPointData().GetArray("Solution"))
    assert (values == whole[3][ids]).all() == (place != "Preview")
assert "a quarter of which differs by " in text, text
print("passed")
