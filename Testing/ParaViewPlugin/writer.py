# SPDX-License-Identifier: BSD-3-Clause
"""The writer: by extension, streamed past the guard, byte for byte."""

import filecmp
import os
import sys

import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

folder = t.make_folder()
reader = OpenDataFile(t.BUNNY)
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
stream = os.path.join(folder, "again.smb")
SaveData(stream, proxy=reader, NumberOfPieces=9)
assert filecmp.cmp(stream, t.BUNNY, shallow=False)

poisson = t.make_poisson(t.make_problem(reader))
container = os.path.join(folder, "solved.vsm")
SaveData(container, proxy=poisson)
solved = OpenDataFile(container)
solved.UpdatePipeline()
assert solved.GetDataInformation().GetNumberOfPoints() == t.BUNNY_POINTS
assert solved.GetDataInformation().GetNumberOfCells() == t.BUNNY_CELLS
assert solved.PointData["Solution"].GetNumberOfComponents() == 3
assert "Solution" in solved.PointArrayStatus
assert sorted(os.listdir(folder)) == ["again.smb", "solved.vsm"]

# Scripts write piece files past the guard, too; Save Data leaves them to ParaView's own writer.
pieces = os.path.join(folder, "pieces.pvtp")
writer = servermanager.writers.StreamingMeshWriter(Input=poisson, FileName=pieces, NumberOfPieces=5)
writer.UpdatePipeline()
assert len(os.listdir(os.path.join(folder, "pieces"))) == 5
reread = OpenDataFile(pieces)
reread.UpdatePipeline()
assert reread.GetDataInformation().GetNumberOfCells() == t.BUNNY_CELLS
ball = os.path.join(folder, "ball.pvtp")
SaveData(ball, proxy=Sphere(), DataMode="Binary")
ball = OpenDataFile(ball)
ball.UpdatePipeline()
assert ball.GetDataInformation().GetNumberOfCells() == 96

# Where a preview is shown, Save Data saves the mesh, also after Calculators and solves.
calculator = Calculator(Input=reader, Function="coordsX", ResultArrayName="X")
calculator.UpdatePipeline()
assert calculator.GetDataInformation().GetNumberOfPoints() <= 10000
for name in ("whole.ply", "whole.vtp", "whole.vtkhdf", "whole.pvtp"):
    for source, array in (calculator, "X"), (poisson, "Solution"):
        SaveData(os.path.join(folder, name), proxy=source)
        path = os.path.join(folder, name)
        # Before 5.12 ParaView opens VTKHDF by the suffix .hdf alone.
        whole = VTKHDFReader(FileName=[path]) if name.endswith("hdf") else OpenDataFile(path)
        whole.UpdatePipeline()
        assert whole.GetDataInformation().GetNumberOfCells() == t.BUNNY_CELLS, name
        assert name.endswith("ply") or array in whole.PointData.keys(), whole.PointData.keys()
        Delete(whole)
# Formats of which ParaView has no writer, of the mesh of a preview and of one that is whole.
for source, name, cells in (calculator, "whole.off", t.BUNNY_CELLS), (Sphere(), "sphere.off", 96):
    SaveData(os.path.join(folder, name), proxy=source)
    whole = StreamingMeshConverter(FileName=os.path.join(folder, name), OutputFileName=os.path.join(folder, name + ".vsm"))
    whole.UpdatePipeline()
    assert whole.GetDataInformation().GetNumberOfCells() == cells, name
    Delete(whole)
# ParaView's own readers find the normals and texture coordinates of the mesh in every format that has them, and so does ours.
textured = TextureMaptoSphere(Input=Sphere(ThetaResolution=30, PhiResolution=30), PreventSeam=0)
textured.UpdatePipeline()
expected = servermanager.Fetch(textured).GetPointData()
expected.GetTCoords().SetName("TextureCoordinates")
scan = os.path.join(folder, "textured.vtp")
SaveData(scan, proxy=textured)
opened = StreamingMeshConverter(FileName=scan, OutputFileName=os.path.join(folder, "textured.vsm"))
opened.UpdatePipeline()
for name, text, read in (("a.vtp", 0, lambda path: XMLPolyDataReader(FileName=[path])),
                         ("a.vtu", 0, lambda path: XMLUnstructuredGridReader(FileName=[path])),
                         ("a.vtk", 0, lambda path: LegacyVTKReader(FileNames=[path])),
                         ("b.vtk", 1, lambda path: LegacyVTKReader(FileNames=[path])),
                         ("a.ply", 0, lambda path: PLYReader(FileNames=[path])),
                         ("a.obj", 0, lambda path: WavefrontOBJReader(FileName=path))):
    path = os.path.join(folder, name)
    servermanager.writers.StreamingMeshWriter(Input=opened, FileName=path, WriteText=text).UpdatePipeline()
    ours = StreamingMeshConverter(FileName=path, OutputFileName=path + ".vsm", Order="Keep")
    for reader_of_file in (read(path), ours):
        reader_of_file.UpdatePipeline()
        found = servermanager.Fetch(reader_of_file)
        assert found.GetNumberOfPoints() == expected.GetNormals().GetNumberOfTuples(), (name, found.GetNumberOfPoints())
        if reader_of_file is ours and name.endswith("obj"):
            continue  # of corners there
        for get in "GetNormals", "GetTCoords":
            array, same = getattr(found.GetPointData(), get)(), getattr(servermanager.Fetch(opened).GetPointData(), get)()
            assert array and (t.vtk_to_numpy(array) == t.vtk_to_numpy(same)).all(), (name, get, array)
# Nothing in the file could tell another order than that of the sphere.
points = servermanager.Fetch(Sphere()).GetPoints()
with open(os.path.join(folder, "sphere.off"), encoding="ascii") as file:
    lines = [line.split() for line in file][2:2 + points.GetNumberOfPoints()]
assert all(abs(float(line[k]) - points.GetPoint(i)[k]) < 1e-6 for i, line in enumerate(lines) for k in range(3)), lines[:3]
# Save Data of a preview configures one writer: without a second name of the file, with the arrays to choose.
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()


def dialog(suffix, source):
    """The writer, and the properties that its dialog shows."""
    writer = factory.CreateWriter(os.path.join(folder, "shown." + suffix), source.SMProxy, 0)
    hidden = {"Input"} | {writer.GetHints().GetNestedElement(k).GetAttribute("name")
                          for k in range(writer.GetHints().GetNumberOfNestedElements())
                          if writer.GetHints().GetNestedElement(k).GetAttribute("show") == "0"}
    properties = writer.NewPropertyIterator()
    properties.Begin()
    shown = set()
    while not properties.IsAtEnd():
        if properties.GetProperty().GetPanelVisibility() == "default" and properties.GetKey() not in hidden:
            shown.add(properties.GetKey())
        properties.Next()
    label = writer.GetXMLLabel()
    writer.UnRegister(None)
    return label, shown


ARRAYS = {"ChooseArraysToWrite", "PointDataArrays", "CellDataArrays"}
for suffixes, source, properties in (("ply obj stl vtk vtp vtu", reader, {"RestoreOrder", "WriteText"} | ARRAYS),
                                     ("vtkhdf pvtp pvtu vsm", reader, {"NumberOfPieces"} | ARRAYS),
                                     ("csv case", reader, set())):
    for suffix in suffixes.split():
        label, shown = dialog(suffix, source)
        assert label.startswith("Streaming Mesh Writer") and shown == properties, (suffix, label, shown)

# Chosen arrays alone are written.
SaveData(os.path.join(folder, "chosen.vtp"), proxy=calculator, ChooseArraysToWrite=1, PointDataArrays=["X"], CellDataArrays=[])
whole = OpenDataFile(os.path.join(folder, "chosen.vtp"))
whole.UpdatePipeline()
assert whole.GetDataInformation().GetNumberOfCells() == t.BUNNY_CELLS
assert set(whole.PointData.keys()) - {"GlobalIds", "vtkGhostType", "StreamFinalized"} == {"X"}, whole.PointData.keys()
assert not whole.CellData.keys(), whole.CellData.keys()

# A preview that the user requested is saved as a preview.
preview = StreamingMeshPreview(Input=calculator, PreviewPoints=10000)
SaveData(os.path.join(folder, "preview.stl"), proxy=preview)
shown = OpenDataFile(os.path.join(folder, "preview.stl"))
shown.UpdatePipeline()
assert 0 < shown.GetDataInformation().GetNumberOfPoints() < 10001
print("passed")
