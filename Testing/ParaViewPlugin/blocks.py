# SPDX-License-Identifier: BSD-3-Clause
"""Every filter on every kind of data of several blocks: of one block with cells it has the result of that block, in
the same structure, and of others it says in a sentence how to go on. No filter is greyed for them.

blocks.py PLUGIN"""

import os
import sys

import numpy as np

import smg_testing as t
from paraview import servermanager
from paraview.simple import *
from paraview.vtk import (vtkAMRBox, vtkMultiBlockDataSet, vtkMultiPieceDataSet, vtkOutputWindow, vtkOverlappingAMR,
                          vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPoints, vtkPolyData,
                          vtkStringOutputWindow, vtkStructuredGrid, vtkUniformGrid, vtkUnstructuredGrid)
from paraview.vtk.util.numpy_support import vtk_to_numpy

LoadPlugin(sys.argv[1], ns=globals())

LOW, HIGH = '"halfspace": [0, 0, -1, 0.3]', '"halfspace": [0, 0, 1, 0.3]'


def region(make, **properties):
    def made(source):
        proxy = make(Input=source, RegionFunction="Plane", **properties)
        proxy.RegionFunction.Normal = [0, 0, 1]
        return proxy

    return made


def handles(source):
    up = dict(Motion="Similarity", Translation=[0, 0, 1])
    low = MeshHandle(Input=source, RegionFunction="Plane", **up)
    low.RegionFunction.Origin, low.RegionFunction.Normal = [0, 0, -0.3], [0, 0, 1]
    high = MeshHandle(Input=low, RegionFunction="Plane", **up)
    high.RegionFunction.Origin, high.RegionFunction.Normal = [0, 0, 0.3], [0, 0, -1]
    return high


FILTERS = {
    "MeshRegion": region(MeshRegion),
    "MeshCondition": region(MeshCondition),
    "MeshHandle": region(MeshHandle),
    "StreamingPoisson": lambda source: StreamingPoisson(
        Input=source, Problem='{"dirichlet": [{%s, "value": 0}, {%s, "value": 1}]}' % (LOW, HIGH)),
    "StreamingMeshDeformation": lambda source: StreamingMeshDeformation(Input=handles(source)),
    "StreamingMeshSmoothing": lambda source: StreamingMeshSmoothing(Input=source, Hold="{%s}" % LOW),
    "StreamingDistance": lambda source: StreamingDistance(Input=source, From="{%s}" % LOW),
    "StreamingMeshArea": lambda source: StreamingMeshArea(Input=source, Of="{%s}" % LOW),
    "StreamingBlend": lambda source: StreamingBlend(Input=source, Patch="Scan", Arrays=["Light"]),
    "StreamingMeshSimplification": lambda source: StreamingMeshSimplification(Input=source),
    "StreamingMeshPreview": lambda source: StreamingMeshPreview(Input=source),
}


def ball():
    """A sphere with the arrays that the filters take."""
    source = Sphere(ThetaResolution=24, PhiResolution=24)
    data = t.client_object(t.make_scans(source))
    data.Update()
    mesh = vtkPolyData()
    mesh.DeepCopy(data.GetOutputDataObject(0))
    return mesh


def image():
    data = vtkUniformGrid()
    data.SetDimensions(3, 3, 3)
    return data


def grid():
    data = vtkStructuredGrid()
    data.SetDimensions(2, 2, 1)
    points = vtkPoints()
    for k in range(4):
        points.InsertNextPoint(k % 2, k // 2, 0)
    data.SetPoints(points)
    return data


def solid():
    """Tetrahedra."""
    data = t.client_object(Tetrahedralize(Input=Wavelet(WholeExtent=[-2, 2, -2, 2, -2, 2])))
    data.Update()
    mesh = vtkUnstructuredGrid()
    mesh.DeepCopy(data.GetOutputDataObject(0))
    return mesh


def preview():
    """The preview of a reader."""
    reader = StreamingMeshReader(FileName=t.BUNNY, MaximumPointsInMemory=1000, PreviewPoints=1000)
    reader.UpdatePipeline()
    mesh = vtkPolyData()
    mesh.DeepCopy(t.client_object(reader).GetOutputDataObject(0))
    return mesh


def blocks(*leaves, kind=vtkMultiBlockDataSet):
    data = kind()
    set_leaf = {vtkMultiBlockDataSet: "SetBlock", vtkPartitionedDataSetCollection: "SetPartitionedDataSet"}
    for k, leaf in enumerate(leaves):
        getattr(data, set_leaf.get(kind, "SetPartition" if "Partition" in kind.__name__ else "SetPiece"))(k, leaf)
    return data


def partitions(*leaves):
    return blocks(*leaves, kind=vtkPartitionedDataSet)


def collection(*leaves):
    return blocks(*leaves, kind=vtkPartitionedDataSetCollection)


def amr():
    data = vtkOverlappingAMR()
    data.Initialize(1, [1])
    data.SetOrigin([0.0, 0.0, 0.0])
    data.SetGridDescription(8)
    data.SetSpacing(0, [1.0, 1.0, 1.0])
    data.SetAMRBox(0, 0, vtkAMRBox(0, 0, 0, 1, 1, 1))
    data.SetDataSet(0, 0, image())
    return data


BALL, EMPTY, PREVIEW = ball(), vtkPolyData(), preview()
# Data with one block of cells; what the filters say of others.
SINGLE = {
    "a block": blocks(BALL),
    "a block in a block": blocks(blocks(None, blocks(BALL))),
    "a block beside empty ones": blocks(None, EMPTY, vtkUnstructuredGrid(), blocks(), BALL),
    "a piece of a block": blocks(blocks(BALL, kind=vtkMultiPieceDataSet)),
    "a partition": partitions(BALL),
    "a partition beside empty ones": partitions(EMPTY, BALL, None),
    "a collection": collection(partitions(), partitions(EMPTY, BALL)),
}
JOIN = "Merge Blocks"
REFUSED = {
    "two blocks": (blocks(BALL, BALL), JOIN),
    "a surface and a solid": (blocks(BALL, solid()), JOIN),
    "two blocks of blocks": (blocks(blocks(BALL), blocks(EMPTY, BALL)), JOIN),
    "two partitions": (partitions(BALL, BALL), JOIN),
    "a collection of two": (collection(partitions(BALL), partitions(BALL)), JOIN),
    "a preview": (blocks(PREVIEW), "is the preview of a mesh"),
    "a preview beside another mesh": (blocks(BALL, blocks(PREVIEW)), "is the preview of a mesh"),
    "no block": (blocks(), "none with cells"),
    "empty blocks": (blocks(EMPTY, vtkUnstructuredGrid()), "none with cells"),
    "an empty collection": (collection(partitions(EMPTY)), "none with cells"),
    "a block and an image": (blocks(BALL, image()), "several blocks"),
    "an image": (blocks(image()), "Tetrahedralize"),
    "a structured grid": (blocks(grid()), "Tetrahedralize"),
    "AMR": (amr(), "Tetrahedralize"),
}


def source_of(data):
    source = TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def is_offered(name, source):
    """Whether the menu offers the filter for the source."""
    prototype = servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy("filters", name)
    port = prototype.GetProperty("Input")
    port.RemoveAllUncheckedProxies()
    port.AddUncheckedInputConnection(source.SMProxy, 0)
    offered = port.IsInDomains()
    port.RemoveAllUncheckedProxies()
    return offered > 0


def leaves(data):
    """All leaves with their places."""
    if not data.IsA("vtkCompositeDataSet"):
        return {0: data}
    found, at = {}, data.NewIterator()
    at.InitTraversal()
    while not at.IsDoneWithTraversal():
        found[at.GetCurrentFlatIndex()] = at.GetCurrentDataObject()
        at.GoToNextItem()
    return found


def arrays_of(data):
    both = data.GetPointData(), data.GetCellData()
    found = {(k, arrays.GetArrayName(i)): vtk_to_numpy(arrays.GetArray(i))
             for k, arrays in enumerate(both) for i in range(arrays.GetNumberOfArrays())}
    found["points"] = vtk_to_numpy(data.GetPoints().GetData())
    return found


def result_of(make, data):
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    source = source_of(data)
    made = make(source)
    made.UpdatePipeline()
    vtkOutputWindow.SetInstance(None)
    return source, made, t.client_object(made).GetOutputDataObject(0), window.GetOutput()


wrong = []
for name, make in FILTERS.items():
    _, _, expected, said = result_of(make, BALL)
    if name != "StreamingMeshPreview":
        assert not said and expected.GetNumberOfCells() > 0, (name, said)
    for kind, data in SINGLE.items():
        source, made, found, text = result_of(make, data)
        if not is_offered(name, source):
            wrong.append((name, kind, "greyed"))
        if name == "StreamingMeshPreview":
            continue
        own, of_input = leaves(found), leaves(data)
        meshes = [(place, leaf) for place, leaf in own.items() if leaf.GetNumberOfCells() > 0]
        if text or len(meshes) != 1:
            wrong.append((name, kind, text))
            continue
        is_kept = found.GetClassName() == data.GetClassName() and own.keys() == of_input.keys()
        if found.IsA("vtkCompositeDataSet") and not (is_kept and of_input[meshes[0][0]] is BALL):
            wrong.append((name, kind, "another structure"))
        here, there = arrays_of(expected), arrays_of(meshes[0][1])
        if here.keys() != there.keys() or not all(np.array_equal(here[k], there[k], equal_nan=True) for k in here):
            wrong.append((name, kind, "another result"))
    for kind, (data, words) in REFUSED.items():
        source, made, found, text = result_of(make, data)
        if not is_offered(name, source):
            wrong.append((name, kind, "greyed"))
        if words not in text:
            wrong.append((name, kind, "says: " + text[-300:]))
        elif sum(leaf.GetNumberOfCells() for leaf in leaves(found).values()) > 0:
            wrong.append((name, kind, "has cells"))

# Blocks that a filter makes anew for each piece of a result that is saved, also inside others.
sphere = TrivialProducer()
sphere.GetClientSideObject().SetOutput(BALL)
nested = GroupDatasets(Input=[GroupDatasets(Input=[sphere])])
for name, make in FILTERS.items():
    if name in ("StreamingMeshPreview", "StreamingMeshSimplification"):
        continue
    made = make(nested)
    made.UpdatePipeline()
    SaveData("nested.vsm", proxy=made)
    read = StreamingMeshReader(FileName=os.path.abspath("nested.vsm"))
    read.UpdatePipeline()
    if t.client_object(read).GetOutputDataObject(0).GetNumberOfPoints() != BALL.GetNumberOfPoints():
        wrong.append((name, "saved blocks of blocks"))
    os.remove("nested.vsm")
    Delete(read)
for row in wrong:
    print(row)
assert not wrong
print("passed")
