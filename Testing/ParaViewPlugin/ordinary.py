# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of ParaView's own sources in the filters, without any preparation: the answers are those on the same
mesh read from a file of its own, and the output is the input with arrays.

ordinary.py PLUGIN"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkStringArray

import smg_testing as t
from paraview import servermanager
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson
folder = t.make_folder()


def hot_and_cold(source, low, high):
    """0 below and 1 above two heights."""
    cold = MeshCondition(Input=source, RegionFunction="Plane", Condition="Dirichlet", Value=0)
    cold.RegionFunction.Origin, cold.RegionFunction.Normal = [0, 0, low], [0, 0, 1]
    hot = MeshCondition(Input=cold, RegionFunction="Plane", Condition="Dirichlet", Value=1)
    hot.RegionFunction.Origin, hot.RegionFunction.Normal = [0, 0, high], [0, 0, -1]
    return hot


def points_and(source, name):
    data = servermanager.Fetch(source)
    return (vtk_to_numpy(data.GetPoints().GetData()).astype(float),
            vtk_to_numpy(data.GetPointData().GetArray(name)).astype(float), data)


def simplices(data):
    """The corners of the triangles, polygons cut from their first corner on, or tetrahedra; None for other cells."""
    cells = []
    ids = vtkIdList()
    for cell in range(data.GetNumberOfCells()):
        kind = data.GetCellType(cell)
        data.GetCellPoints(cell, ids)
        corners = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
        if kind in (5, 7, 9):
            cells += [[corners[0], corners[i - 1], corners[i]] for i in range(2, len(corners))]
        elif kind == 10:
            cells.append(corners)
        else:
            return None
    return np.array(cells)


def solve_here(data, low, high):
    """0 and 1 beyond two heights: linear finite elements, assembled and factorised by numpy; not a number where no
    cell has a volume, and nothing is prescribed."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    cells = simplices(data)
    if cells is None or len(points) > 4000:
        return None
    # The gradients of the hat functions: rows of the pseudoinverse of the edges from the first corner.
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    size = np.sqrt(np.abs(np.linalg.det(edges @ edges.transpose(0, 2, 1))))
    solid = size > 1e-12 * np.linalg.norm(edges, axis=2).max(axis=1)**(cells.shape[1] - 1)
    mentioned, cells, edges = np.unique(cells), cells[solid], edges[solid]
    rest = np.linalg.pinv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-rest.sum(axis=1, keepdims=True), rest], axis=1)
    gram = edges @ edges.transpose(0, 2, 1)
    measures = np.sqrt(np.abs(np.linalg.det(gram))) / (2 if cells.shape[1] == 3 else 6)
    local = measures[:, None, None] * (gradients @ gradients.transpose(0, 2, 1))
    matrix = np.zeros((len(points), len(points)))
    for i in range(cells.shape[1]):
        for j in range(cells.shape[1]):
            np.add.at(matrix, (cells[:, i], cells[:, j]), local[:, i, j])
    used = np.unique(cells)
    fixed = (points[:, 2] <= low) | (points[:, 2] >= high)
    solution = np.full(len(points), np.nan)
    solution[mentioned] = np.where(fixed[mentioned], points[mentioned, 2] >= high, np.nan)
    free = used[~fixed[used]]
    held = used[fixed[used]]
    solution[free] = np.linalg.solve(matrix[np.ix_(free, free)], -matrix[np.ix_(free, held)] @ solution[held])
    return solution


def check(name, source):
    source.UpdatePipeline()
    bounds = source.GetDataInformation().GetBounds()
    low, high = bounds[4] + 0.1 * (bounds[5] - bounds[4]), bounds[5] - 0.1 * (bounds[5] - bounds[4])
    poisson = StreamingPoisson(Input=hot_and_cold(source, low, high))
    points, solution, data = points_and(poisson, "Solution")
    poisson.UpdatePropertyInformation()
    assert poisson.GetPropertyValue("Outcome").startswith("Converged"), poisson.GetPropertyValue("Outcome")
    before = servermanager.Fetch(source)
    independent = solve_here(before, low, high)
    if independent is not None:
        global compared
        compared += 1
        off = np.nanmax(np.abs(independent - solution))
        assert off < 1e-6 and np.array_equal(np.isnan(independent), np.isnan(solution)), (name, off)
    assert (data.GetNumberOfPoints(), data.GetNumberOfCells()) == (
        before.GetNumberOfPoints(), before.GetNumberOfCells()), name
    assert not data.GetPointData().GetGlobalIds() and not data.GetPointData().HasArray("StreamFinalized")
    # The same mesh as a stream of its own.
    file = os.path.join(folder, name + (".vtp" if data.IsA("vtkPolyData") else ".vtu"))
    SaveData(file, proxy=source, DataMode="Binary")
    stream = os.path.join(folder, name + ".vsm")
    t.run_smg("convert", file, stream)
    there = StreamingPoisson(Input=hot_and_cold(OpenDataFile(stream), low, high))
    _, found, shown = points_and(there, "Solution")
    numbers = vtk_to_numpy(shown.GetPointData().GetArray("OriginalId"))
    known = np.full(len(points), np.nan)
    known[numbers] = found
    assert np.array_equal(np.isnan(known), np.isnan(solution)), name
    difference = np.nanmax(np.abs(known - solution))
    assert difference < 1e-6 and np.nanmin(solution) > -0.1 and np.nanmax(solution) < 1.1, (name, difference)
    # What is saved is the mesh with its solution.
    saved = os.path.join(folder, name + "-solved" + os.path.splitext(file)[1])
    SaveData(saved, proxy=poisson)
    assert np.array_equal(points_and(OpenDataFile(saved), "Solution")[1], solution, equal_nan=True), name
    distance = StreamingDistance(Input=source, From='{"nearest": [[%g, %g, %g]]}' % tuple(points[numbers[0]]))
    _, away, _ = points_and(distance, "Distance")
    straight = np.linalg.norm(points - points[numbers[0]], axis=1)
    reached = np.isfinite(away)
    assert reached.any() and (away[reached] > straight[reached] * (1 - 1e-6) - 1e-6).all(), name


def check_outcome():
    """The panel shows the Outcome of the last update, which is after its properties are applied."""
    poisson = StreamingPoisson(Input=hot_and_cold(Sphere(), -0.4, 0.4))
    shown = poisson.SMProxy.GetProperty("Outcome")
    seen = []
    for tolerance in (1e-6, 1e-2):
        poisson.Tolerance = tolerance
        poisson.UpdatePipeline()
        seen.append(shown.GetElement(0))
    assert all(text.startswith("Converged") for text in seen) and seen[0] != seen[1], seen


def check_motions(source):
    """A translation of two handles moves all points; smoothing and blending keep what a plane and constants are."""
    source.UpdatePipeline()
    before, _, bounds = *points_and(source, "Elevation")[:2], source.GetDataInformation().GetBounds()
    up = dict(Motion="Similarity", Translation=[1, 2, 3])
    first = MeshHandle(Input=source, RegionFunction="Plane", **up)
    first.RegionFunction.Origin, first.RegionFunction.Normal = [bounds[0] + 0.2, 0, 0], [1, 0, 0]
    second = MeshHandle(Input=first, RegionFunction="Plane", **up)
    second.RegionFunction.Origin, second.RegionFunction.Normal = [bounds[1] - 0.2, 0, 0], [-1, 0, 0]
    deformed = StreamingMeshDeformation(Input=second)
    points, _, data = points_and(deformed, "Elevation")
    assert np.abs(points - before - [1, 2, 3]).max() < 1e-4, np.abs(points - before - [1, 2, 3]).max()
    assert data.GetNumberOfCells() == servermanager.Fetch(source).GetNumberOfCells()


def check_texts():
    """Arrays of texts are in the output of what adds arrays, and are not said to be left out; what makes another mesh
    says that they are."""
    grid = Sphere(ThetaResolution=60, PhiResolution=40)
    grid.UpdatePipeline()
    data = servermanager.Fetch(grid)
    texts = vtkStringArray()
    texts.SetName("Material")
    for cell in range(data.GetNumberOfCells()):
        texts.InsertNextValue("steel" if cell % 2 else "glass")
    data.GetCellData().AddArray(texts)
    source = TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    solved = StreamingPoisson(Input=hot_and_cold(source, -0.45, 0.45))
    solved.UpdatePipeline()
    solved.UpdatePropertyInformation()
    assert "texts" not in solved.GetPropertyValue("Notes"), solved.GetPropertyValue("Notes")
    assert servermanager.Fetch(solved).GetCellData().GetAbstractArray("Material").GetValue(1) == "steel"
    simple = StreamingMeshSimplification(Input=source, NumberOfVertices=500)
    simple.UpdatePipeline()
    simple.UpdatePropertyInformation()
    assert "left out: 'Material'" in simple.GetPropertyValue("Outcome"), simple.GetPropertyValue("Outcome")


compared = 0
check_texts()
wavelet = Wavelet(WholeExtent=[-7, 7, -7, 7, -7, 7])
tetrahedra = Tetrahedralize(Input=wavelet)
ply = os.path.join(folder, "ball.ply")
SaveData(ply, proxy=Sphere(ThetaResolution=50, PhiResolution=40, Radius=100))
check("sphere", Sphere(ThetaResolution=60, PhiResolution=40))
check("tetrahedra", tetrahedra)
check("plane", Plane(Origin=[0, 0, 0], Point1=[3, 0, 0], Point2=[0, 1, 3], XResolution=40, YResolution=30))
check("contour", Contour(Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0]))
check("clip", Clip(Input=tetrahedra, ClipType="Sphere"))
check("clip through points", Clip(Input=tetrahedra))  # makes cells without volume, and points of these alone
check("hexahedra", Threshold(Input=wavelet, Scalars=["POINTS", "RTData"], LowerThreshold=-1e9, UpperThreshold=1e9))
check("ply", OpenDataFile(ply))
for grid in (Plane(XResolution=30, YResolution=20, Point1=[5, 0, 0]),
             Threshold(Input=wavelet, Scalars=["POINTS", "RTData"], LowerThreshold=100, UpperThreshold=1e9)):
    check_motions(Elevation(Input=grid))
check_outcome()
smooth = StreamingMeshSmoothing(Input=Elevation(Input=Plane(XResolution=30, YResolution=20)), Boundary="Fixed")
flat, _, _ = points_and(smooth, "Elevation")
assert np.abs(flat[:, 2]).max() < 1e-6
# Points that are not reached do not make the defaults of what follows infinite.
near = StreamingDistance(Input=Sphere(), From='{"vertices": [0]}', Within=0.4)
near.UpdatePipeline()
assert not np.isfinite(points_and(near, "Distance")[1]).all()
threshold = Threshold(Input=near, Scalars=["POINTS", "Distance"])
assert threshold.UpperThreshold <= 0.4, threshold.UpperThreshold
assert np.isfinite(list(Contour(Input=near, ContourBy=["POINTS", "Distance"]).Isosurfaces)).all()
# Of the cells of several dimensions, the highest count; what is left of points and cells is said.
both = StreamingDistance(Input=AppendDatasets(Input=[tetrahedra, Sphere()]), From='{"vertices": [0]}')
both.UpdatePipeline()
both.UpdatePropertyInformation()
for part in ("50 points are corners of no tetrahedron", "96 points, lines and surface cells are left out, since"):
    assert part in both.GetPropertyValue("Notes"), both.GetPropertyValue("Notes")
# Texts are no coefficients.
words = ProgrammableFilter(Input=Sphere(), Script="""
from vtkmodules.vtkCommonCore import vtkStringArray
words = vtkStringArray()
words.SetName("Words")
words.SetNumberOfValues(inputs[0].GetNumberOfPoints())
output.GetPointData().AddArray(words)
output.PointData.append(inputs[0].Points[:, 0], "Numbers")""")
words.UpdatePipeline()
poisson = StreamingPoisson(Input=words)
for name in ("DirichletMask", "DirichletValues", "Source", "InitialGuess", "ScreeningArray", "ConductivityArray", "FieldArray"):
    domain = poisson.SMProxy.GetProperty(name).FindDomain("vtkSMArrayListDomain")
    offered = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
    assert "Numbers" in offered and "Words" not in offered, (name, offered)
assert compared >= 5, compared
print("passed")
