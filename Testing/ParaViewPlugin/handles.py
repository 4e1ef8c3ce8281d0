# SPDX-License-Identifier: BSD-3-Clause
"""Mesh handles: the points they hold on a mesh shown as a preview and streamed past the guard."""

import os
import sys

import numpy
import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

folder = t.make_folder()
container = os.path.join(folder, "bunny.vsm")
SaveData(container, proxy=OpenDataFile(t.BUNNY))
reader = OpenDataFile(container)
reader.UpdatePipeline()
whole = t.pull(t.client_object(reader), 1)[0]
points = whole[2].astype(float)
assert len(points) == t.BUNNY_POINTS and (whole[0] == numpy.arange(len(points))).all()
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
reader.PreviewPoints = 2000
reader.UpdatePipeline()


def arrays(data, *names):
    values = [t.vtk_to_numpy(data.GetPointData().GetArray(name)).copy() for name in names]
    return values if len(values) > 1 else values[0]


def shown(handle):
    """The displayed data: the preview with its ids, and which of its points are held."""
    handle.UpdatePipeline()
    data = t.servermanager.Fetch(handle)
    assert data.GetFieldData().GetArray("Preview").GetValue(0) == 1
    ids, mask = arrays(data, "GlobalIds", "HandleMask")
    assert count(handle) == (mask > 0).sum()
    return data, ids[mask > 0]


def streamed(handle):
    """The handle arrays of the whole mesh, streamed to a file and read again."""
    path = os.path.join(folder, "handled.vsm")
    SaveData(path, proxy=handle)
    handled = StreamingMeshReader(FileName=path)
    handled.UpdatePipeline()
    data = t.servermanager.Fetch(handled)
    assert data.GetNumberOfPoints() == t.BUNNY_POINTS
    names = ("HandleMask", "HandleTarget", "HandleRotation", "HandleLogScale")
    result = arrays(data, *names)
    Delete(handled)
    return result


def count(handle):
    handle.UpdatePropertyInformation()
    return handle.GetPropertyValue("NumberOfHeldPoints")


def around(centers, radius):
    """Which points of the mesh are within the radius of one of the centres."""
    near = numpy.zeros(len(points), dtype=bool)
    for center in centers:
        near |= ((points - center) ** 2).sum(axis=1) <= radius * radius
    return near


# A new handle fits its input and reports no error.
handle = MeshHandle(Input=reader)
low, high = points.min(axis=0), points.max(axis=0)
assert handle.Region == "Function" and handle.Motion == "Fixed"
assert handle.RegionFunction.GetXMLName() == "Sphere"
assert (low < handle.Center).all() and (handle.Center < high).all(), list(handle.Center)
assert numpy.allclose(handle.RegionFunction.Center, reader.GetDataInformation().GetBounds()[1::2]), list(handle.RegionFunction.Center)
assert 0.0 < handle.RegionFunction.Radius < (high - low).max()
# Of an input that has not been executed nothing is known: then the centre is the origin until it is set, or reset.
behind = MeshHandle(Input=MeshHandle(Input=reader))
assert list(behind.Center) == [0, 0, 0], list(behind.Center)
behind.Input.UpdatePipeline()
behind.SMProxy.GetProperty("Center").ResetToDomainDefaults()
assert numpy.allclose(behind.Center, handle.Center), (list(behind.Center), list(handle.Center))
Delete(behind)
defaults = {"InsideOut": 0, "IdType": "Global Ids", "Radius": -1.0, "Rings": 0, "Scale": 1.0,
            "RotationAngle": 0.0, "RotationAxis": [0.0, 0.0, 1.0], "Translation": [0.0, 0.0, 0.0],
            "NumberOfPieces": 0}
for name, value in defaults.items():
    found = handle.GetPropertyValue(name)
    assert (list(found) if isinstance(value, list) else found) == value, (name, found)
hints = handle.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
assert hints.GetAttribute("category") == "Streaming Multigrid"

# Functions: the same on the preview and on the mesh as by a formula.
middle = (low + high) / 2
handle.RegionFunction.Center = list(middle)
handle.RegionFunction.Radius = 0.05
expected = around([middle], 0.05)
data, held = shown(handle)
ids = arrays(data, "GlobalIds")
assert len(held) > 10 and (held == ids[expected[ids]]).all()
assert ((streamed(handle)[0] == 1) == expected).all() and count(handle) == expected.sum()
handle.InsideOut = 1
assert ((streamed(handle)[0] == 1) == ~expected).all()
handle.InsideOut = 0
handle.RegionFunction = "Plane"
handle.RegionFunction.Origin = list(middle)
handle.RegionFunction.Normal = [0, 1, 0]
assert ((streamed(handle)[0] == 1) == (points[:, 1] <= middle[1])).all()
handle.RegionFunction = "Box"
handle.RegionFunction.Position = list(low - 1)
handle.RegionFunction.Length = list(middle - low + 1)
assert ((streamed(handle)[0] == 1) == (points <= middle).all(axis=1)).sum() > t.BUNNY_POINTS - 5
handle.RegionFunction = "Cylinder"
handle.RegionFunction.Center = list(middle)
handle.RegionFunction.Axis = [0, 1, 0]
handle.RegionFunction.Radius = 0.02
across = points[:, [0, 2]] - middle[[0, 2]]
assert ((streamed(handle)[0] == 1) == ((across ** 2).sum(axis=1) <= 0.02 ** 2)).sum() > t.BUNNY_POINTS - 5

# A chain: the second handle overrides the first; it rotates, scales and translates.
second = MeshHandle(Input=handle, Motion="Similarity")
second.RegionFunction.Center = list(middle)
second.RegionFunction.Radius = 0.03
second.RotationAxis = [0, 2, 0]
second.RotationAngle = 200.0
second.Center = [0, 0, 0]
second.Scale = 1.5
second.Translation = [1, 0, 0]
mask, target, rotation, scale = streamed(second)
later = around([middle], 0.03)
assert count(second) == later.sum()
assert (mask[later] >= 1).all() and (mask == 2).any() and (mask == 1).any() and (mask == 0).any()
assert abs(rotation[later] - [0, numpy.radians(200), 0]).max() < 1e-12
assert abs(scale[later] - numpy.log(1.5)).max() < 1e-12 and (scale[~later] == 0).all()
c, s = numpy.cos(numpy.radians(200)), numpy.sin(numpy.radians(200))
turned = points @ numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T
assert abs(target - (1.5 * turned + [1, 0, 0]))[later].max() < 1e-12
first = (mask == 1) & ~later
assert (target[first] == points[first]).all()

# Arrays of a script, such as those of a file, are handles too, beside those of a filter.
marked = Calculator(Input=reader, ResultArrayName="HandleMask", Function="coordsY < %r" % middle[1])
targeted = Calculator(Input=marked, ResultArrayName="HandleTarget", Function="coords")
both = MeshHandle(Input=targeted)
both.RegionFunction.Center = list(middle)
both.RegionFunction.Radius = 0.03
deformed = StreamingMeshDeformation(Input=both)
both.UpdatePipeline()
assert t.servermanager.Fetch(deformed).GetNumberOfPoints() == 2000
for proxy in (deformed, both, targeted, marked):
    Delete(proxy)

# The same motion by a transform, which can turn by 180 degrees at most.
second.Motion = "Transform"
second.Transform.Translate = [1, 0, 0]
second.Transform.Rotate = [0, 200, 0]
second.Transform.Scale = [1.5, 1.5, 1.5]
mask, transformed, rotation, scale = streamed(second)
assert abs(transformed - target).max() < 1e-12
assert abs(rotation[later] - [0, -numpy.radians(160), 0]).max() < 1e-12

# The box is around the points that are held now, as soon as they are.
for center in (list(middle), list(points[ids[5]])):
    second.RegionFunction.Center = center
    second.UpdatePipeline()
    box = second.Transform.SMProxy.GetProperty("ReferenceBounds")
    box = numpy.array([box.GetElement(k) for k in range(6)]).reshape(3, 2)
    assert (abs(box - numpy.reshape(center, (3, 1))) < 0.03 + 1e-6).all() and (box[:, 0] < box[:, 1]).all(), box

# A selection on the preview holds the vertices that its points represent.
handle = MeshHandle(Input=reader, Region="Selection")
numbers = [3, 100, 101, 400]
handle.Selection = IDSelectionSource(IDs=[n for k in numbers for n in (0, k)], FieldType="POINT")
data, held = shown(handle)
assert (held == ids[numbers]).all(), (held, ids[numbers])
corners = t.vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
edges = points[ids[corners]] - points[ids[numpy.roll(corners, 1, axis=1)]]
radius = numpy.sqrt((edges ** 2).sum(axis=2)).mean() / numpy.sqrt(3)
expected = around(points[held], radius)
mask = streamed(handle)[0]
assert expected.sum() > 20 and ((mask == 1) == expected).all(), (mask.sum(), expected.sum())
handle.Radius = 0.0
assert (numpy.flatnonzero(streamed(handle)[0]) == held).all()
handle.Selection = GlobalIDSelectionSource(GlobalIDs=[int(ids[3]), int(ids[100])], FieldType="POINT")
assert (shown(handle)[1] == ids[[3, 100]]).all()
assert (numpy.flatnonzero(streamed(handle)[0]) == ids[[3, 100]]).all()
handle.Selection = IDSelectionSource(IDs=[0, 5, 0, 6], FieldType="CELL")
assert set(shown(handle)[1]) == set(ids[corners[[5, 6]]].ravel())

# Ids of the mesh, and points with targets.
handle.Region = "Ids"
handle.Ids = [17, 30000, 5]
assert len(shown(handle)[1]) in (2, 3)
assert (numpy.flatnonzero(streamed(handle)[0]) == [5, 17, 30000]).all()
handle.Region = "Points"
handle.Points = list(points[77] + 1e-5) + list(points[5000])
handle.PointTargets = [0, 0, 1, 0, 0, 2]
mask, target, _, _ = streamed(handle)
assert (numpy.flatnonzero(mask) == [77, 5000]).all()
assert (target[[77, 5000]] == [[0, 0, 1], [0, 0, 2]]).all()

# A mask has two named colours, not a continuous legend, unless the user has saved others.
for name, words in (("HandleMask", ["0", "free", "1", "held", "2", "held by several"]),
                    ("Condition1", ["0", "outside", "1", "inside"]),
                    ("RegionMask", ["0", "outside", "1", "inside"])):
    colors = GetColorTransferFunction(name)
    assert colors.InterpretValuesAsCategories == 1 and list(colors.Annotations) == words, (name, colors.Annotations)
# What no source reaches is not coloured as the farthest point.
assert GetColorTransferFunction("Distance").UseAboveRangeColor == 1
print("passed")
