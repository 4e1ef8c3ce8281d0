# SPDX-License-Identifier: BSD-3-Clause
"""Whatever writer ParaView has for a suffix, also one of another plugin: Save Data of a preview or of a failed
filter goes through the writers of this plugin, which know both by the names of field arrays."""

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
        found |= set(hint.GetAttribute("extensions").split()) if hint else set()
        writers.GoToNextItem()
    return sorted(found)


def is_ours(source, suffix):
    """Whether Save Data takes a writer of this plugin; None: it refuses."""
    writer = factory.CreateWriter(os.path.join(folder, "saved." + suffix), source.SMProxy, 0)
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
