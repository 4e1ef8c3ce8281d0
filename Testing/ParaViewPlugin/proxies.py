# SPDX-License-Identifier: BSD-3-Clause
"""The proxies: names, labels, defaults, categories, readers and writers by extension."""

import os
import re
import sys

import smg_testing as t
from paraview.simple import *
from paraview import servermanager as sm

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

reader = OpenDataFile(t.BUNNY)
assert reader.SMProxy.GetXMLName() == "StreamingMeshReader"
assert reader.MaximumPointsInMemory == 2000000
assert reader.PointArrayStatus == ["OriginalId"], reader.PointArrayStatus
poisson = StreamingPoisson(Input=reader)
defaults = {"Solve": "Automatic", "Weights": "Cotangent", "Sweeps": 2, "Tolerance": 1e-8,
            "MaximumCycles": 50, "MemoryLimit": 1024, "ScratchDirectory": "", "ScratchLimit": 0,
            "NumberOfPieces": 0,
            "NumberOfThreads": 0, "Screening": 0.0, "InCore": 0, "ResultArrayName": "Solution",
            "DirichletMask": ["POINTS", "None"], "Source": ["POINTS", "None"]}
for name, value in defaults.items():
    found = poisson.GetPropertyValue(name)
    found = list(found) if isinstance(value, list) else found
    assert found == value, (name, found)
for name in ("Residual", "Cycles", "Passes", "PeakMemory", "Converged", "Estimate", "Outcome", "Notes",
             "Report"):
    assert poisson.SMProxy.GetProperty(name).GetInformationOnly(), name
    # The panel shows the summary line and the notes.
    is_shown = poisson.SMProxy.GetProperty(name).GetPanelVisibility() == "default"
    assert is_shown == (name in ("Estimate", "Outcome", "Notes")), name

assert StreamingMeshDeformation(Input=reader).Tolerance == 1e-6

simplified = StreamingMeshSimplification(Input=reader, NumberOfVertices=3000)
simplified.UpdatePropertyInformation()
estimate = simplified.GetPropertyValue("Estimate")
assert f"over {t.BUNNY_POINTS:,} points and {t.BUNNY_CELLS:,} cells" in estimate, estimate
simplified.UpdatePipeline()
assert simplified.GetDataInformation().GetNumberOfPoints() <= 3000
simplified.UpdatePropertyInformation()
outcome = simplified.GetPropertyValue("Outcome")
assert outcome.startswith("3,000 points and ") and "error" in outcome, outcome
assert 0 < simplified.GetPropertyValue("ReachedError") < 0.01

smoothing = StreamingMeshSmoothing(Input=reader)
defaults = {"Size": 4.0, "SizeUnit": "Mean Edges", "Steps": 1, "KeepVolume": 1, "KeepEdges": 0,
            "EdgeAngle": 30.0, "Boundary": "Automatic", "Hold": "", "Array": "None", "Column": "None"}
for name, value in defaults.items():
    assert smoothing.GetPropertyValue(name) == value, (name, smoothing.GetPropertyValue(name))

# What a solve costs is stated before it is applied.
smoothing.UpdatePropertyInformation()
estimate = smoothing.GetPropertyValue("Estimate")
assert f"over {t.BUNNY_POINTS:,} points and {t.BUNNY_CELLS:,} cells" in estimate, estimate
assert smoothing.GetPropertyValue("Passes") == 0

# What a filter that was not applied says of its last run is nothing, not None.
for make in (StreamingPoisson, StreamingMeshSimplification, StreamingMeshPreview, MeshHandle):
    fresh = make(Input=reader)
    for name in ("Error", "Report", "Notes"):
        if fresh.SMProxy.GetProperty(name):
            assert fresh.GetPropertyValue(name) == "", (make, name, fresh.GetPropertyValue(name))
    fresh.UpdatePropertyInformation()
    assert fresh.GetPropertyValue("Error") == "", (make, fresh.GetPropertyValue("Error"))
    Delete(fresh)

# Columns is the former name of Arrays.
blend = StreamingBlend(Input=reader, Patch="scan", Arrays=["Colors", "Heat"], Columns=["Colors"])
assert list(blend.Arrays) == ["Colors", "Heat"] and list(blend.Columns) == ["Colors"] and blend.Anchor == 0.01 and blend.Hold == ""

distance = StreamingDistance(Input=reader)
defaults = {"From": "", "Wall": 0, "Source": 0, "Group": 0, "Direction": 0, "Accuracy": "Automatic", "MaximumPasses": 200}
for name, value in defaults.items():
    assert distance.GetPropertyValue(name) == value, (name, distance.GetPropertyValue(name))

region = MeshRegion(Input=reader)
defaults = {"Region": "Function", "RegionName": "RegionMask", "MaskArray": "None", "TagArray": "None", "Tag": 0.0}
for name, value in defaults.items():
    assert region.GetPropertyValue(name) == value, (name, region.GetPropertyValue(name))
kinds = ["Function", "Selection", "Ids", "Points", "Boundary", "Mask", "Tag", "Group", "Everywhere"]
for proxy in (region, MeshHandle(Input=reader), MeshCondition(Input=reader)):
    assert list(proxy.GetProperty("Region").Available) == kinds, proxy.GetProperty("Region").Available

# A label is the name with spaces, so that the Python name equals the name.
for proxy in (reader, poisson, smoothing, blend, distance, StreamingMeshArea(Input=reader), region, MeshHandle(Input=reader)):
    iterator = proxy.SMProxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        name, label = iterator.GetKey(), iterator.GetProperty().GetXMLLabel()
        assert re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name) == label or label == name, (name, label)
        assert iterator.GetProperty().GetDocumentation() or name in ("PointArrayInfo", "CellArrayInfo"), name
        iterator.Next()

# A plugin that is loaded later changes no definition: ParaView then forgets which properties override others.
manager = sm.ProxyManager().SMProxyManager


def definition(group, name):
    """The default, the visibility and the domains of each property."""
    proxy = manager.NewProxy(group, name)
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    found = {}
    while not iterator.IsAtEnd():
        one = iterator.GetProperty()
        value = [one.GetElement(i) for i in range(one.GetNumberOfElements())] if hasattr(one, "GetElement") else None
        domains = one.NewDomainIterator()
        domains.Begin()
        names = set()
        while not domains.IsAtEnd():
            names.add(domains.GetKey())
            domains.Next()
        found[iterator.GetKey()] = value, one.GetPanelVisibility(), names
        iterator.Next()
    proxy.UnRegister(None)
    return found


names = [("filters", name) for name in ("MeshRegion", "MeshHandle", "MeshCondition", "StreamingPoisson", "StreamingBlend",
                                        "StreamingMeshDeformation", "StreamingMeshSmoothing", "StreamingDistance",
                                        "StreamingMeshArea")]
names += [("writers", name) for name in ("BigMeshWriter", "BigMeshPieces", "BigMeshFailure", "BigMeshRefusal",
                                     "WholeMeshRefusal")]
for turn in range(2):
    known = {name: definition(*name) for name in names}
    # In the other order, since a definition may take something from another.
    another = os.path.join(t.make_folder(), f"another{turn}.xml")
    with open(another, "w", encoding="ascii") as file:
        file.write("<ServerManagerConfiguration><ProxyGroup name='sources'><SourceProxy name='Another"
                   f"{turn}' class='vtkSphereSource'/></ProxyGroup></ServerManagerConfiguration>")
    LoadPlugin(another, ns=globals())
    names.reverse()
    for name in names:
        assert definition(*name) == known[name], (name, definition(*name), known[name])

hints = poisson.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
assert hints.GetAttribute("category") == "Streaming Multigrid"
writers = sm.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
names = writers.GetSupportedFileTypes(reader.SMProxy, 0)
for extension in ("vsm", "sma", "smb", "sva", "svb"):
    assert "*." + extension in names, names

# File > Open offers the converter for formats that ParaView does not read, and for large meshes.
folder = t.make_folder()
medit, small, large = (os.path.join(folder, name) for name in ("m.mesh", "small.ply", "large.ply"))
with open(medit, "w", encoding="utf-8") as file:
    file.write("MeshVersionFormatted 1\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
               "Triangles\n1\n1 2 3 0\nEnd\n")
SaveData(small, Sphere())
header = ("ply\nformat binary_little_endian 1.0\nelement vertex 3000000\nproperty float x\nproperty float y\n"
          "property float z\nelement face 6000000\nproperty list uchar int vertex_indices\nend_header\n")
with open(large, "wb") as file:
    file.write(header.encode())
    file.truncate(len(header) + 3000000 * 12 + 6000000 * 13)
factory = sm.vtkSMProxyManager.GetProxyManager().GetReaderFactory()


def readers_of(path):
    found = factory.GetReaders(path, sm.ActiveConnection.Session)
    return [found.GetString(i) for i in range(1, found.GetNumberOfStrings(), 3)]


assert readers_of(medit) == ["streaminglargemesh"], readers_of(medit)
image = os.path.join(folder, "image.vtk")
with open(image, "wb") as file:
    file.write(b"# vtk DataFile Version 3.0\nan image\nBINARY\nDATASET STRUCTURED_POINTS\n")
    file.truncate(200 << 20)
assert readers_of(image) == ["LegacyVTKFileReader"], readers_of(image)
assert readers_of(small) == ["PLYReader"], readers_of(small)
# Scripts take the first one.
assert readers_of(large) == ["PLYReader", "streaminglargemesh"], readers_of(large)
converter = StreamingMeshConverter()
converter.UpdatePropertyInformation()
assert converter.GetPropertyValue("Estimate").startswith("Known once a mesh file is named"), converter.GetPropertyValue("Estimate")
converter.FileName = large
converter.UpdatePropertyInformation()
estimate = converter.GetPropertyValue("Estimate")
assert estimate.startswith("About 3.00 million points and 6.00 million cells: "), estimate
print("passed")
