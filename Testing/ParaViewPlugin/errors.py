# SPDX-License-Identifier: BSD-3-Clause
"""Errors are reported in one sentence, without a crash."""

import os
import re
import sys

import numpy as np
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkObject, vtkStringArray, vtkStringOutputWindow, vtkOutputWindow

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

messages = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(messages)


def said():
    text = messages.GetOutput()
    fresh = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(fresh)
    globals()["messages"] = fresh
    return text


folder = t.make_folder()
with open(t.BUNNY, "rb") as file:
    data = file.read()
for name, content in {"cut.smb": data[:600000], "empty.smb": b"", "noise.smb": data[::-1][:5000],
                      "empty.vsm": b"", "noise.vsm": data[1000:9000]}.items():
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(content)
    reader = StreamingMeshReader(FileName=path)
    try:
        reader.UpdatePipeline()
    except RuntimeError:
        pass
    text = said()
    assert name in text, (name, text)
    reader.UpdatePropertyInformation()
    assert name in reader.GetPropertyValue("Error"), reader.GetPropertyValue("Error")
    reader.FileName = t.BUNNY
    reader.UpdatePipeline()
    reader.UpdatePropertyInformation()
    assert reader.GetPropertyValue("Error") in ("", None) and not said()
    Delete(reader)

# A failure is reported once, however often a view updates, until something changes.
reader = OpenDataFile(t.BUNNY)
poisson = StreamingPoisson(Input=reader, Problem='{"dirichlet": [{"sphere": [9, 9, 9, 1], "value": 1}]}')
Show(poisson, CreateView("RenderView"))
Render()
Render()
text = said()
assert text.count("no vertex of the mesh is in this region") == 1, text
assert "Algorithm vtkStreaming" not in text, text
poisson.UpdatePipeline()
assert said() == ""
poisson.Tolerance = 1e-5
poisson.UpdatePipeline()
text = said()
assert text.count("no vertex of the mesh is in this region") == 1 and text.count("ERROR") == 1, text
poisson.Problem = '{"dirichlet": [{"halfspace": [0, 1, 0, 0.1], "value": 1}]}'
Render()
assert said() == "" and "Solution" in poisson.PointData.keys()
# A view updates again after a failure anywhere.
condition = MeshCondition(Input=reader, Region="Ids", Ids=[0])
other = MeshCondition(Input=condition, Region="Ids", Ids=[9], Value=1)
poisson.Input = other
poisson.Problem = ""
Render()


def largest():
    data = poisson.SMProxy.GetClientSideObject().GetOutputDataObject(0)
    solution = data.GetPointData().GetArray("Solution")
    return solution.GetRange()[1] if solution else None


assert abs(largest() - 1.0) < 1e-6, said()
for break_it, mend_it in ((lambda: setattr(poisson, "Conductivity", 0), lambda: setattr(poisson, "Conductivity", 2)),
                          (lambda: setattr(condition, "Ids", [10 ** 9]), lambda: setattr(condition, "Ids", [1]))):
    break_it()
    Render()
    text = said()
    assert text.count("ERR") == 1, text
    assert largest() is None
    for value in 3, 4:
        mend_it()
        other.Value = value
        Render()
        assert abs(largest() - value) < 1e-6, said()
Delete(poisson)
Delete(other)
Delete(condition)

# What is no array of numbers is refused as that.
ball = servermanager.Fetch(Sphere(ThetaResolution=20))
names = vtkStringArray()
names.SetName("Material")
for _ in range(ball.GetNumberOfCells()):
    names.InsertNextValue("steel")
ball.GetCellData().AddArray(names)
texts = TrivialProducer()
texts.GetClientSideObject().SetOutput(ball)
poisson = StreamingPoisson(Input=MeshCondition(Input=texts, Region="Ids", Ids=[0]),
                           ConductivityArray=["CELLS", "Material"])
poisson.UpdatePipeline()
text = said()
assert "the array 'Material' is one of texts" in text, text
Delete(poisson)

# Formats that are written by pieces or not at all, so that a preview cannot be mistaken for the
# mesh.
folder = t.make_folder()
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
calculator = Calculator(Input=reader, Function="coordsX", ResultArrayName="X")
calculator.UpdatePipeline()
# Every other writer that ParaView has for it refuses it: see guarded_writers.py.
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
suffixes = re.findall(r"\*\.(\w+)", factory.GetSupportedFileTypes(calculator.SMProxy, 0))
written = {"vsm", "sma", "smb", "sva", "svb", "ply", "obj", "off", "stl", "mesh", "msh", "node", "ele", "inp", "e", "exo", "ex2", "g", "vtk", "vtp", "vtu", "vtkhdf",
           "pvtp", "pvtu"}
assert "stl" in suffixes and "csv" in suffixes, suffixes
whole = os.path.join(folder, "whole.obj")
SaveData(whole, proxy=calculator)
with open(whole, encoding="ascii") as file:
    assert sum(line.startswith("v ") for line in file) == 34834, "not the mesh but its preview"
said()
for name in ("shown." + suffix for suffix in sorted(set(suffixes) - written)):
    SaveData(os.path.join(folder, name), proxy=calculator)
    text = said()
    assert "Streaming Mesh Preview" in text and not os.path.exists(os.path.join(folder, name)), text
Delete(calculator)
reader.MaximumPointsInMemory = 2000000

# What a failed filter delivers is saved in no format, and scripts learn why.
empty = MeshRegion(Input=reader, Region="Mask")
empty.UpdatePipeline()
said()
for name in ("Error", "NumberOfHeldPoints"):
    empty.UpdatePropertyInformation()
    assert ("no mask array" in empty.GetPropertyValue(name)) if name == "Error" else not empty.GetPropertyValue(name)
after = Calculator(Input=empty, Function="coordsX", ResultArrayName="X")
after.UpdatePipeline()
said()
for source in empty, after:
    for suffix in sorted(set(suffixes) - {"pvd", "vtm"} | {"vtp", "vsm"}):
        path = os.path.join(folder, "failed." + suffix)
        SaveData(path, proxy=source)
        text = said()
        assert "could not be made" in text and not os.path.exists(path), (suffix, text)
empty.Region = "Boundary"
path = os.path.join(folder, "mended.stl")
SaveData(path, proxy=empty)
assert os.path.getsize(path) > 1000, said()
empty.UpdatePropertyInformation()
assert empty.GetPropertyValue("Error") in ("", None) and not said()
Delete(after)
Delete(empty)

# A data set of several blocks.
blocks = GroupDatasets(Input=[Sphere(), Sphere()])
for make in (MeshHandle, MeshRegion, StreamingMeshDeformation, StreamingMeshPreview, StreamingMeshSmoothing,
             StreamingPoisson, StreamingBlend, StreamingDistance, StreamingMeshArea):
    refused = make(Input=blocks)
    refused.UpdatePipeline()
    text = said()
    assert "Merge Blocks" in text, (make, text)
    Delete(refused)

# A sphere that was not fitted to the data, which had not been read yet.
handle = MeshHandle(Input=StreamingMeshReader(FileName=t.BUNNY))
handle.UpdatePipeline()
text = said()
assert "update the input first" in text or handle.RegionFunction.Radius > 0.0, text

# Insufficient memory is reported in advance, with both figures.
reader = OpenDataFile(t.BUNNY)
poisson = t.make_poisson(t.make_problem(reader))
poisson.MemoryLimit = 1
poisson.UpdatePipeline()
assert "memory" in said().lower()
poisson.MemoryLimit = 1024
poisson.UpdatePipeline()
text = said()
assert "Solution" in poisson.PointData.keys(), text

# A preview without its marks is not the mesh; seldom do filters take these away.
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 2000
passed = PassArrays(Input=reader, PointDataArrays=["Normals"])
for make in (StreamingMeshSmoothing, StreamingMeshSimplification,
             lambda Input: StreamingDistance(Input=MeshRegion(Input=Input, Region="Ids", Ids=[0]))):
    make(Input=passed).UpdatePipeline()
    text = said()
    assert "is made of a preview" in text, text

# A filter behind a handle moves the points that it holds.
sphere = Sphere(ThetaResolution=40, PhiResolution=40)
handle = MeshHandle(Input=sphere, Region="Ids", Ids=[0])
for by in 0, 10:
    moved = Transform(Input=handle)
    moved.Transform.Translate = [by, 0, 0]
    StreamingMeshDeformation(Input=moved).UpdatePipeline()
    text = said()
    assert ("no longer where it held them" in text) == (by > 0), (by, text)

# A filter before a region gives points that it makes the ids of others.
numbered = ProgrammableFilter(Input=sphere, Script="""
import numpy
output.ShallowCopy(inputs[0].VTKObject)
output.PointData.append(numpy.arange(output.GetNumberOfPoints()), "OriginalId")
""")
for change in (lambda: numbered), (lambda: Subdivide(Input=numbered)):
    changed = change()
    several, counts = np.unique(t.points_of(changed, "OriginalId"), return_counts=True)
    last = several[counts == counts.max()][0]
    MeshRegion(Input=changed, Region="Ids", IdType="Original Ids", Ids=[int(last)]).UpdatePipeline()
    text = said()
    assert ("Points at several places have the id %d" % last in text) == (counts.max() > 1), (last, text)
    assert (counts.max() > 1) == (changed is not numbered), counts.max()

# Output of Python would go to the window that collects the messages.
os.write(1, b"passed\n")
