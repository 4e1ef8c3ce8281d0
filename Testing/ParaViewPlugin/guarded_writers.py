# SPDX-License-Identifier: BSD-3-Clause
"""Whatever writer ParaView has for a suffix, also one of another plugin: Save Data of a preview or of a failed
filter, and of what is made of them, goes through the writers of this plugin, which know both by the names of field
arrays."""

import os
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkOutputWindow, vtkStringOutputWindow

vtkOutputWindow.SetInstance(vtkStringOutputWindow())  # the failures are wanted
folder = t.make_folder()
# A writer that nobody knows, the first one by its name, of a suffix of its own and of one of others.
other = os.path.join(folder, "other.xml")
with open(other, "w", encoding="ascii") as file:
    file.write("""
<ServerManagerConfiguration><ProxyGroup name="writers">
  <WriterProxy name="AForeignWriter" class="vtkXMLPolyDataWriter" supports_parallel="1">
    <InputProperty name="Input" command="SetInputConnection">
      <ProxyGroupDomain name="groups"><Group name="sources"/><Group name="filters"/></ProxyGroupDomain>
      <DataTypeDomain name="input_type"><DataType value="vtkPolyData"/></DataTypeDomain>
    </InputProperty>
    <StringVectorProperty name="FileName" command="SetFileName" number_of_elements="1"/>
    <Hints><WriterFactory extensions="foo vtp" file_description="Foreign"/></Hints>
  </WriterProxy>
</ProxyGroup></ServerManagerConfiguration>""")
for plugin in (sys.argv[1], other) if "--first" in sys.argv else (other, sys.argv[1]):
    LoadPlugin(plugin, ns=globals())
manager = servermanager.ProxyManager().SMProxyManager
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()


def suffixes():
    """Of all writers that ParaView has."""
    found = set()
    writers = manager.GetProxyDefinitionManager().NewSingleGroupIterator("writers")
    writers.InitTraversal()
    while not writers.IsDoneWithTraversal():
        hints = writers.GetProxyHints()
        hint = hints.FindNestedElementByName("WriterFactory") if hints else None
        found |= set((hint and hint.GetAttribute("extensions") or "").split())
        writers.GoToNextItem()
    return sorted(found)


def is_ours(source, suffix):
    """Whether Save Data takes a writer of this plugin; None: it refuses."""
    writer = factory.CreateWriter(os.path.join(folder, "saved." + suffix), source.SMProxy, source.Port)
    name = writer and writer.GetVTKClassName()
    if writer:
        writer.UnRegister(None)
    return name and name == "vtkStreamingMeshWriter"


assert {"foo", "vtp", "csv", "vtm", "stl"} <= set(suffixes()), suffixes()
reader = StreamingMeshReader(FileName=t.BUNNY, MaximumPointsInMemory=1000, PreviewPoints=10000)
calculator = Calculator(Input=reader, Function="coordsX", ResultArrayName="X")
failed = MeshRegion(Input=reader, Region="Mask")
after_it = Calculator(Input=failed, Function="coordsX", ResultArrayName="X")
for source in reader, calculator, failed, after_it:
    source.UpdatePipeline()
    for suffix in suffixes():
        assert is_ours(source, suffix), (source, suffix)
for suffix in "foo", "csv":
    path = os.path.join(folder, "saved." + suffix)
    SaveData(path, proxy=calculator)
    assert not os.path.exists(path), suffix
# Nor among other blocks.
group = GroupDatasets(Input=[calculator, Sphere()])
group.UpdatePipeline()
for suffix in suffixes():
    assert is_ours(group, suffix) is not False, suffix
# Nor what has none of the field arrays, since it is a table, an image or a line.
distance = StreamingDistance(Input=MeshRegion(Input=reader, Region="Points", Points=[0.0575, 0.0525, 0.0192]),
                             To='{"nearest": [[-0.06, 0.18, 0.0]]}', Solve="Preview")
distance.UpdatePipeline()
sphere = Sphere()
for begin in calculator, failed, after_it:
    made = [Histogram(Input=begin), DescriptiveStatistics(Input=begin), PlotOverLine(Input=begin),
            IntegrateVariables(Input=begin), ResampleToImage(Input=begin), GroupDatasets(Input=[begin, sphere]),
            ResampleWithDataset(SourceDataArrays=begin, DestinationMesh=sphere),
            PlotData(Input=Histogram(Input=begin))]
    for source in made:
        with t.Silence():
            source.UpdatePipeline()
        for suffix in suffixes():
            assert is_ours(source, suffix), (begin, source, suffix)
        with t.Silence() as window:
            SaveData(os.path.join(folder, "saved.csv"), proxy=source)
        assert not os.path.exists(os.path.join(folder, "saved.csv")), (begin, source)
        said = window.GetOutput()
        assert "Streaming Mesh Preview" in said if begin is calculator else "see" in said, (source, said)
    for source in made:
        Delete(source)
# What a filter of this plugin says of its solve, and what is made of a mesh of its own, is of the whole.
for source in OutputPort(distance, 1), PlotData(Input=OutputPort(distance, 1)), Histogram(
        Input=StreamingMeshPreview(Input=calculator, PreviewPoints=10000)):
    source.UpdatePipeline()
    writer = factory.CreateWriter(os.path.join(folder, "saved.csv"), source.SMProxy, source.Port)
    assert writer and writer.GetVTKClassName() != "vtkStreamingMeshWriter", source
    writer.UnRegister(None)

# Shortest paths of a preview are saved as those of the mesh.
whole = StreamingDistance(Input=MeshRegion(Input=StreamingMeshReader(FileName=t.BUNNY), Region="Points",
                                           Points=[0.0575, 0.0525, 0.0192]), To=distance.To)
lengths = [servermanager.Fetch(source, idx=3).GetCellData().GetArray("Length").GetValue(0)
           for source in (whole, distance)]
assert lengths[0] != lengths[1], lengths
for suffix in "vtp", "vtk", "obj", "ply", "csv", "pvtp", "vsm":
    path = os.path.join(folder, "paths." + suffix)
    SaveData(path, proxy=OutputPort(distance, 3))
    assert os.path.exists(path) == (suffix in ("vtp", "vtk", "obj")), suffix
    if suffix in ("vtp", "vtk"):
        saved = servermanager.Fetch(OpenDataFile(path))
        assert saved.GetCellData().GetArray("Length").GetValue(0) == lengths[0], suffix
    assert servermanager.Fetch(distance, idx=3).GetCellData().GetArray("Length").GetValue(0) == lengths[1]
with open(os.path.join(folder, "paths.obj"), encoding="ascii") as file:
    assert sum(line.startswith("v ") for line in file) == saved.GetNumberOfPoints()
assert is_ours(OutputPort(whole, 3), "vtp") is False and is_ours(OutputPort(distance, 3), "csv")
with t.Silence():
    nothing = StreamingDistance(Input=failed, To=distance.To)
    nothing.UpdatePipeline()
for port in range(4):
    assert is_ours(OutputPort(nothing, port), "csv"), port

# Nor at each step of an animation.
extractor = manager.GetPrototypeProxy("extract_writers", "VTP")
assert not extractor.CanExtract(reader.SMProxy) and not extractor.CanExtract(failed.SMProxy)

# Everything else is left to others: field arrays of the shape of the marks, too.
alike = ProgrammableFilter(Input=Sphere(), Script="""
from paraview.vtk import vtkUnsignedCharArray
output.ShallowCopy(inputs[0].VTKObject)
for components in 17, 19:
    array = vtkUnsignedCharArray()
    array.SetName(f"Of{components}")
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(1)
    output.GetFieldData().AddArray(array)
""")
alike.UpdatePipeline()
assert len(alike.FieldData.keys()) == 2
for source in Sphere(), alike:
    for suffix in "foo", "ply", "vtp", "csv", "pvd", "stl":
        assert is_ours(source, suffix) is False, (source, suffix)
assert extractor.CanExtract(alike.SMProxy)
preview = StreamingMeshPreview(Input=calculator, PreviewPoints=10000)
preview.UpdatePipeline()
assert is_ours(preview, "foo") is False
os.write(1, b"passed\n")
