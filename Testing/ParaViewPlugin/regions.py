# SPDX-License-Identifier: BSD-3-Clause
"""Regions of all kinds in Mesh Region, Mesh Handle and Mesh Condition: streamed past the guard, in memory, on previews
and on ordinary meshes. The results are those of the same places in JSON, bit for bit.

regions.py PLUGIN"""

import os
import sys

import numpy as np

import smg_testing as t
from paraview import servermanager
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
folder = t.make_folder()
SINK = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "heat_sink.msh")
EAR = [-0.0175, 0.187, -0.02]


def saved(source, *names):
    """Point arrays of the whole mesh, streamed to a file and read again; "points" are the positions."""
    path = os.path.join(folder, "saved.vsm")
    SaveData(path, proxy=source)
    reader = StreamingMeshReader(FileName=path)
    data = servermanager.Fetch(reader)
    arrays = [t.vtk_to_numpy(data.GetPoints().GetData() if name == "points" else data.GetPointData().GetArray(name)).copy()
              for name in names]
    Delete(reader)
    return arrays[0] if len(arrays) == 1 else arrays


def shown(source, name):
    return t.points_of(source, name)[:, 0]


def shown_points(source):
    return t.vtk_to_numpy(servermanager.Fetch(source).GetPoints().GetData()).copy()


def held(handle):
    handle.UpdatePropertyInformation()
    return handle.GetPropertyValue("NumberOfHeldPoints")


def open_vsm(mesh, name):
    path = os.path.join(folder, name)
    t.run_smg("convert", mesh, path)
    return StreamingMeshReader(FileName=path)


def check(reader, kinds):
    """Each kind of region with the same place in JSON, once in memory and once above the guard."""
    distances, solutions = {}, {}
    for guard in (2000000, 500):
        reader.MaximumPointsInMemory = guard
        for place, settings in kinds.items():
            region = MeshRegion(Input=reader, **settings)
            measured = StreamingDistance(Input=region)
            marks, distance = saved(measured, "RegionMask", "Distance")
            if place not in distances:
                written = StreamingDistance(Input=reader, From=place)
                distances[place] = saved(written, "Distance")
                assert np.array_equal(shown(measured, "Distance"), shown(written, "Distance")), place
                Delete(written)
            assert np.array_equal(distance, distances[place]), (place, guard)
            assert marks.dtype == np.uint8 and np.array_equal(marks == 1, distance == 0), (place, guard)
            assert 0 < marks.sum() and marks.max() == 1, place
            # A handle and a condition hold the same points.
            handle = MeshHandle(Input=reader, **settings)
            assert np.array_equal(saved(handle, "HandleMask"), marks), (place, guard)
            condition = MeshCondition(Input=reader, Condition="Dirichlet", Value=2, **settings)
            solution = saved(StreamingPoisson(Input=condition, Problem='{"source": [1]}'), "Solution")
            if place not in solutions:
                problem = '{"source": [1], "dirichlet": [{%s, "value": [2]}]}' % place[1:-1]
                solutions[place] = saved(StreamingPoisson(Input=reader, Problem=problem), "Solution")
            assert np.array_equal(solution, solutions[place]), (place, guard)
            if guard == 500:
                # Some points of the preview are in the region, and the count is that of the preview.
                preview = shown(region, "RegionMask")
                assert 0 < preview.sum() == held(region) <= len(preview) <= 10000, place
            for proxy in (measured, region, handle, condition):
                Delete(proxy)


# A surface.
reader = open_vsm(t.BUNNY, "bunny.vsm")
reader.PreviewPoints = 4000
check(reader, {
    '{"boundary": true}': {"Region": "Boundary"},
    '{"nearest": [[-0.0175, 0.187, -0.02]]}': {"Region": "Points", "Points": EAR},
    '{"vertices": [7, 30000]}': {"Region": "Ids", "Ids": [7, 30000], "IdType": "Original Ids"}})

# Mesh Regions of one name are a union; smoothing holds it, with what Hold names.
for guard in (2000000, 1000):
    reader.MaximumPointsInMemory = guard
    rim = MeshRegion(Input=reader, Region="Boundary", RegionName="Still")
    ear = MeshRegion(Input=rim, Region="Points", Points=EAR, Radius=0.01, RegionName="Still")
    points = saved(reader, "points")
    other = MeshRegion(Input=ear, Region="Points", Points=points[5].tolist(), Radius=0.01)
    marks = saved(other, "Still")
    near = ((points.astype(float) - EAR) ** 2).sum(axis=1) <= 0.01 ** 2
    rim_marks = saved(rim, "Still")
    assert marks.sum() > rim_marks.sum() and (marks >= rim_marks).all()
    assert abs(int((marks | (rim_marks == 1)).sum()) - int((near | (rim_marks == 1)).sum())) < 20
    SaveData(os.path.join(folder, "marked.vsm"), proxy=other)
    marked = StreamingMeshReader(FileName=os.path.join(folder, "marked.vsm"))
    marked.MaximumPointsInMemory = guard
    smoothing = StreamingMeshSmoothing(Input=other, Hold='{"halfspace": [0, 1, 0, 0.17]}')
    expected = StreamingMeshSmoothing(
        Input=marked, Hold='[{"mask": "Still"}, {"mask": "RegionMask"}, {"halfspace": [0, 1, 0, 0.17]}]')
    smooth = saved(smoothing, "points")
    assert np.array_equal(smooth, saved(expected, "points"))
    fixed = (smooth == points).all(axis=1)
    assert fixed[marks == 1].all() and fixed[5] and not fixed.all()

# The array of a region is one of others.
reader.MaximumPointsInMemory = 1000
again = MeshHandle(Input=ear, Region="Mask", MaskArray="Still")
assert np.array_equal(saved(again, "HandleMask"), marks)
assert np.array_equal(shown(again, "HandleMask"), shown(ear, "Still"))
tagged = MeshHandle(Input=ear, Region="Tag", TagArray="Still", Tag=0)
assert np.array_equal(saved(tagged, "HandleMask"), 1 - marks)
everywhere = MeshHandle(Input=ear, Region="Everywhere")
assert shown(everywhere, "HandleMask").all() and held(everywhere) == len(shown(ear, "Still"))
assert saved(everywhere, "HandleMask").all() and held(everywhere) == t.BUNNY_POINTS
lows, highs = list(everywhere.GetPropertyValue("HeldBounds"))[::2], list(everywhere.GetPropertyValue("HeldBounds"))[1::2]
assert np.allclose(lows, points.min(axis=0), atol=0.005) and np.allclose(highs, points.max(axis=0), atol=0.005)
ear.UpdatePipeline()
ear.UpdatePropertyInformation()
around = np.array(ear.GetPropertyValue("HeldBounds")).reshape(3, 2)
assert (around[:, 1] - around[:, 0] <= 0.2).all() and around[0, 0] <= EAR[0] <= around[0, 1]
# A solve removes the arrays of conditions, and no others.
condition = MeshCondition(Input=MeshCondition(Input=ear, Region="Mask", MaskArray="Still", Value=1),
                          Region="Points", Points=points[5].tolist(), Value=0)
solved = StreamingPoisson(Input=condition)
assert 0 < saved(solved, "Solution").max() <= 1.001 and np.array_equal(saved(solved, "Still"), marks)
assert "Condition2" in condition.PointData.keys() and "Condition2" not in solved.PointData.keys()

# A solid: tags of cells, and the boundary.
sink = open_vsm(SINK, "sink.vsm")
sink.PreviewPoints = 800
for cells in ("Surface", "Tetrahedra"):
    sink.PreviewCells = cells
    sink.MaximumPointsInMemory = 500
    region = MeshRegion(Input=sink, Region="Boundary")
    marks = shown(region, "RegionMask")
    assert marks.all() if cells == "Surface" else 0 < marks.sum(), (cells, marks.sum(), len(marks))
# Of tetrahedra a preview is coarse, however many points it may have.
sink.PreviewPoints = 100000
sink.UpdatePipeline()
sink.UpdatePropertyInformation()
assert 0 < 20 * sink.GetDataInformation().GetNumberOfPoints() <= sink.GetPropertyValue("FullNumberOfPoints")
sink.PreviewPoints = 800
check(sink, {'{"tag": ["PhysicalTag", 1]}': {"Region": "Tag", "TagArray": "PhysicalTag", "Tag": 1},
             '{"boundary": true}': {"Region": "Boundary"}})



def write_block(path, n):
    """A block of tetrahedra as a file of Gmsh, with named faces at x = 0 and in the middle, and named cells."""
    def number(i, j, k):
        return (i * (n + 1) + j) * (n + 1) + k + 1
    corners = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    lines = []
    for i, j, k in np.ndindex(n, n, n):
        at = [number(i + a, j + b, k + c) for a, b, c in corners]
        for first, second in ((1, 3), (1, 5), (2, 3), (2, 6), (4, 5), (4, 6)):
            lines.append("4 2 %d 1 %d %d %d %d" % (1 + (2 * i >= n), at[0], at[first], at[second], at[7]))
        if i in (0, n // 2):
            for middle in (1, 2):
                lines.append("2 2 %d 1 %d %d %d" % (3 if i == 0 else 4, at[0], at[middle], at[3]))
    with open(path, "w", encoding="utf-8") as file:
        file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n3 1 "left half"\n3 2 "right half"\n'
                   '2 3 "inlet"\n2 4 "film"\n$EndPhysicalNames\n$Nodes\n%d\n' % (n + 1) ** 3)
        for i, j, k in np.ndindex(n + 1, n + 1, n + 1):
            file.write("%d %d %d %d\n" % (number(i, j, k), i, j, k))
        file.write("$EndNodes\n$Elements\n%d\n" % len(lines))
        file.writelines("%d %s\n" % (1 + at, line) for at, line in enumerate(lines))
        file.write("$EndElements\n")


# Groups of faces, on the boundary and inside, and of cells.
write_block(os.path.join(folder, "block.msh"), 12)
block = open_vsm(os.path.join(folder, "block.msh"), "block.vsm")
block.PreviewPoints = 800
check(block, {'{"group": "inlet"}': {"Region": "Group", "GroupName": "inlet"},
              '{"group": "left half"}': {"Region": "Group", "GroupName": "left half"}})
for guard in (2000000, 500):
    block.MaximumPointsInMemory = guard
    region = MeshRegion(Input=block, Region="Group", GroupName="film")
    region.UpdatePipeline()
    region.UpdatePropertyInformation()
    assert list(region.GetPropertyValue("GroupNames")) == ["left half", "right half", "inlet", "film"]
    assert saved(region, "RegionMask").sum() == 13**2, guard
    # A condition shows its group as the region does, of the preview, too.
    for name in ("film", "left half"):
        condition = MeshCondition(Input=block, Condition="Flux", Value=1, Region="Group", GroupName=name)
        marked = shown(MeshRegion(Input=block, Region="Group", GroupName=name), "RegionMask")
        assert np.array_equal(shown(condition, "Condition1"), marked) and 0 < marked.sum() < len(marked), (guard, name)
        condition.UpdatePropertyInformation()
        assert condition.Outcome.startswith(f"{int(marked.sum()):,} points"), condition.Outcome
        data = servermanager.Fetch(condition).GetPointData()
        assert data.GetScalars().GetName() == "Condition1"
    # A source on the film, and what conducts on its right.
    conducts = MeshCondition(Input=block, Condition="Conductivity", Value=3, Region="Group", GroupName="right half")
    cold = MeshCondition(Input=conducts, Condition="Dirichlet", Value=0, Region="Group", GroupName="inlet")
    warm = MeshCondition(Input=cold, Condition="Flux", Value=2, Region="Group", GroupName="film")
    hot = MeshCondition(Input=warm, Condition="Dirichlet", Value=0, Region="Function", RegionFunction="Plane")
    hot.RegionFunction.Origin, hot.RegionFunction.Normal = [12, 6, 6], [-1, 0, 0]
    solution, points = saved(StreamingPoisson(Input=hot, Tolerance=1e-10), "Solution", "points")
    # 2 = T / 6 + 3 T / 6 per area.
    expected = np.where(points[:, 0] < 6, points[:, 0] / 6, (12 - points[:, 0]) / 6) * 3
    assert np.abs(solution - expected).max() < 1e-6, np.abs(solution - expected).max()

# Groups of an ordinary mesh, as ParaView's own reader has them.
t.run_smg("convert", os.path.join(folder, "block.msh"), os.path.join(folder, "block.vtu"))
ordinary = XMLUnstructuredGridReader(FileName=[os.path.join(folder, "block.vtu")])
for group, count in (("film", 13**2), ("left half", 7 * 13**2)):
    for filter in (MeshRegion(Input=ordinary), MeshCondition(Input=ordinary)):
        filter.Region, filter.GroupName = "Group", group
        name = "RegionMask" if filter.GetXMLName() == "MeshRegion" else "Condition1"
        assert shown(filter, name).sum() == count, (group, name)
cold = MeshCondition(Input=ordinary, Condition="Dirichlet", Value=0, Region="Group", GroupName="inlet")
warm = MeshCondition(Input=cold, Condition="Dirichlet", Value=1, Region="Group", GroupName="film")
measured = StreamingDistance(Input=MeshRegion(Input=ordinary, Region="Group", GroupName="film"))
for scratch in ("", folder):
    solved = StreamingPoisson(Input=warm, ScratchDirectory=scratch, Tolerance=1e-10)
    points, u = shown_points(solved), shown(solved, "Solution")
    assert np.abs(u - np.minimum(points[:, 0] / 6, 1)).max() < 1e-6
    measured.ScratchDirectory = scratch
    assert (shown(measured, "Distance") == 0).sum() == 13**2

# A surface cut out of a solid still has the arrays of its cells: the groups of their faces are none of its edges.
block.MaximumPointsInMemory = 2000000
surface = ExtractSurface(Input=block)
region = MeshRegion(Input=surface, Region="Group", GroupName="left half")
assert shown(region, "RegionMask").sum() == 13**2 + 6 * 48
left = Threshold(Input=block, Scalars=["CELLS", "PhysicalTag"], LowerThreshold=1, UpperThreshold=1)
region = MeshRegion(Input=left, Region="Group", GroupName="inlet")
assert shown(region, "RegionMask").sum() == 13**2
SaveData(os.path.join(folder, "surface.vtp"), proxy=surface)
t.run_smg("convert", os.path.join(folder, "surface.vtp"), os.path.join(folder, "surface.vsm"))

# Ordinary meshes, of any cells: in memory, and sorted into a stream.
plane = Plane(XResolution=5, YResolution=4)
wavelet = Wavelet(WholeExtent=[-3, 3, -3, 3, -3, 3])
voxels = Threshold(Input=wavelet, Scalars=["POINTS", "RTData"], LowerThreshold=-1e9, UpperThreshold=1e9)
half = Sphere(ThetaResolution=40, PhiResolution=30, StartTheta=0, EndTheta=180)
for mesh, count in ((plane, 18), (Triangulate(Input=plane), 18), (TriangleStrips(Input=Triangulate(Input=plane)), 18),
                    (voxels, 7**3 - 5**3), (Tetrahedralize(Input=wavelet), 7**3 - 5**3), (half, 58)):
    region = MeshRegion(Input=mesh, Region="Boundary")
    for scratch in ("", folder):
        measured = StreamingDistance(Input=region, ScratchDirectory=scratch)
        written = StreamingDistance(Input=mesh, From='{"boundary": true}', ScratchDirectory=scratch)
        assert np.array_equal(shown(measured, "Distance"), shown(written, "Distance"), equal_nan=True), mesh
        assert shown(measured, "RegionMask").sum() == count == (shown(measured, "Distance") == 0).sum(), mesh
    mesh.UpdatePipeline()
    near = MeshRegion(Input=mesh, Region="Points", Points=list(servermanager.Fetch(mesh).GetPoint(0)))
    assert shown(near, "RegionMask").sum() == 1, mesh
    handle = MeshHandle(Input=region, Region="Mask", MaskArray="RegionMask")
    assert shown(handle, "HandleMask").sum() == count, mesh
ids = GenerateIds(Input=plane, CellIdsArrayName="Number", PointIdsArrayName="Other")
tagged = MeshRegion(Input=ids, Region="Tag", TagArray="Number", Tag=7)
assert shown(tagged, "RegionMask").sum() == 4
# Points on the surface of a shape are inside, also where it is turned.
grid = Tetrahedralize(Input=Wavelet(WholeExtent=[0, 20, 0, 20, 0, 20]))
for corner, turned in (([10, 0, 0], [0, 0, 90]), ([10, 10, 0], [0, 0, 180]), ([0, 10, 0], [90, 0, 0]), ([0, 0, 10], [0, 90, 0])):
    box = MeshRegion(Input=grid, RegionFunction="Box")
    box.RegionFunction.Position, box.RegionFunction.Length, box.RegionFunction.Rotation = corner, [10] * 3, turned
    assert shown(box, "RegionMask").sum() == 11**3, turned
for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1]):
    cylinder = MeshRegion(Input=grid, RegionFunction="Cylinder")
    cylinder.RegionFunction.Center, cylinder.RegionFunction.Radius, cylinder.RegionFunction.Axis = [10] * 3, 10, axis
    inside = sum((y - 10) ** 2 + (z - 10) ** 2 <= 100 for y in range(21) for z in range(21))
    assert shown(cylinder, "RegionMask").sum() == 21 * inside, axis
held_at_one = MeshCondition(Input=grid, Region="Ids", Ids=[0], Value=3)
solved = StreamingPoisson(Input=held_at_one, ResultArrayName="Condition1")
assert np.allclose(shown(solved, "Condition1"), 3), "a result with the name of what a condition adds"
saved_as_pieces = os.path.join(folder, "ordinary.vsm")
SaveData(saved_as_pieces, proxy=MeshHandle(Input=half, Region="Boundary"))
assert shown(StreamingMeshReader(FileName=saved_as_pieces), "HandleMask").sum() == 58
print("passed")
