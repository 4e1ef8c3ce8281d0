# SPDX-License-Identifier: BSD-3-Clause
"""Deformation by handles: a preview that follows, and the whole mesh as from the program smg."""

import json
import os
import sys

import deformation_testing as d
import numpy
import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())

folder = t.make_folder()
container, program, saved = (os.path.join(folder, name) for name in
                             ("bunny.vsm", "program.vsm", "saved.vsm"))
handle_file = os.path.join(folder, "handles.json")
t.run_smg("convert", t.BUNNY, container, "--order", "keep")
with open(handle_file, "w", encoding="utf-8") as file:
    json.dump(d.HANDLE_FILE, file)
t.run_smg("deform", container, program, "--handles", handle_file)
expected = OpenDataFile(program)
expected.UpdatePipeline()
whole = t.pull(t.client_object(expected), 1)[0]

reader = OpenDataFile(container)
handles = d.make_handles(reader, MeshHandle)
deformation = StreamingMeshDeformation(Input=handles)
algorithm = t.client_object(deformation)
hints = deformation.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
assert hints.GetAttribute("category") == "Streaming Multigrid"
defaults = {"Weights": "Clamped", "Sweeps": 2, "Tolerance": 1e-6,
            "Cycles": 0, "MaximumCycles": 50, "MemoryLimit": 1024, "ScratchDirectory": "",
            "NumberOfPieces": 0, "NumberOfThreads": 0, "Normals": "Recompute",
            "KeepHandleArrays": 0, "InteractivePoints": 200000}
for name, value in defaults.items():
    assert deformation.GetPropertyValue(name) == value, name


def information(name):
    deformation.UpdatePropertyInformation()
    return deformation.GetPropertyValue(name)


# In memory and in pieces: the numbers are those of the program.
for points, pieces in ((200000, 1), (0, 1), (0, 2), (0, 7), (0, 64)):
    deformation.InteractivePoints = points
    deformation.UpdatePipeline()
    parts = t.pull(algorithm, pieces)
    ids = numpy.concatenate([p[0][p[1]] for p in parts])
    assert (numpy.sort(ids) == numpy.arange(t.BUNNY_POINTS)).all(), pieces
    united = numpy.concatenate([p[2][p[1]] for p in parts])[numpy.argsort(ids)]
    assert united.dtype == whole[2].dtype
    assert (united == whole[2]).all(), (points, pieces, abs(united - whole[2]).max())
    assert (numpy.concatenate([p[4] for p in parts]) == whole[4]).all(), pieces
assert information("NumberOfBuilds") == 1
report = json.loads(information("Report"))
assert report["vertices"] == t.BUNNY_POINTS and report["converged"]
assert [step["name"] for step in report["steps"]] == ["rotation", "position"]
assert report["passes"] == report["cycles"] + 1 == information("Passes")

# Above the guard only the preview is deformed, repeatedly on one hierarchy.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
reader.PreviewPoints = 10000
deformation.UpdatePipeline()
first = t.servermanager.Fetch(deformation)
assert first.GetFieldData().GetArray("Preview").GetValue(0) == 1
assert first.GetFieldData().GetArray("FullNumberOfPoints").GetValue(0) == t.BUNNY_POINTS
assert not first.GetPointData().HasArray("HandleMask")
builds = information("NumberOfBuilds")
handles.RotationAngle = 10.0
deformation.UpdatePipeline()
second = t.servermanager.Fetch(deformation)
assert information("NumberOfBuilds") == builds
assert second.GetNumberOfPoints() == first.GetNumberOfPoints() <= 10000
assert second.GetBounds() != first.GetBounds()
of_preview = json.loads(information("Report"))
assert of_preview["vertices"] == second.GetNumberOfPoints()
assert 0 < information("PeakMemory") == of_preview["pool_bytes_peak"]

# The saved file holds the whole mesh, whatever is shown.
handles.RotationAngle = d.EARS_ANGLE
deformation.UpdatePipeline()
SaveData(saved, proxy=deformation)
written = StreamingMeshReader(FileName=saved)
written.UpdatePipeline()
result = t.pull(t.client_object(written), 1)[0]
for k in (0, 2, 4):
    assert (result[k] == whole[k]).all(), k

# The program can deform a mesh that was saved with its handles.
held = os.path.join(folder, "held.vsm")
SaveData(held, proxy=handles)
with open(handle_file, "w", encoding="utf-8") as file:
    json.dump({"handles": [{"region": {"mask": "HandleMask"}, "target": "HandleTarget",
                            "rotation": "HandleRotation", "logScale": "HandleLogScale"}]}, file)
t.run_smg("deform", held, program, "--handles", handle_file)
by_columns = StreamingMeshReader(FileName=program)
by_columns.UpdatePipeline()
assert (t.pull(t.client_object(by_columns), 1)[0][2] == whole[2]).all()

# The filter that makes a preview.
preview = StreamingMeshPreview(Input=deformation)
assert preview.PreviewPoints == 100000
preview.PreviewPoints = 3000
preview.UpdatePipeline()
data = t.servermanager.Fetch(preview)
assert 500 < data.GetNumberOfPoints() <= 3000
ids = t.vtk_to_numpy(data.GetPointData().GetGlobalIds())
assert (t.vtk_to_numpy(data.GetPoints().GetData()) == whole[2][ids]).all()
preview.UpdatePropertyInformation()
assert preview.GetPropertyValue("FullNumberOfPoints") == t.BUNNY_POINTS
print("passed")
