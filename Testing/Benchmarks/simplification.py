#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simplification of surfaces beside two codes that have the mesh in memory: vtkQuadricDecimation and
meshoptimizer (libmeshoptimizer-dev). Needs VTK's Python modules, as /usr/bin/python3 has with ParaView.

simplification.py SMG VERTICES MESH.ply...: each mesh simplified to VERTICES vertices, or to a share of them below 1.
Prints processor seconds and peak resident MiB of each process, the mean distance and the largest one between
the surface before and after (from samples of both, in % of the diagonal of the mesh), and how many edges have more
than two triangles, or two that are wound against each other."""

import ctypes
import json
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, reference
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation, vtkTriangleFilter
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

SAMPLES = 100000


def read(name):
    reader = vtkPLYReader()
    reader.SetFileName(name)
    filter_ = vtkTriangleFilter()
    filter_.SetInputConnection(reader.GetOutputPort())
    filter_.Update()
    return filter_.GetOutput()


def arrays(mesh):
    cells = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData()).astype(float), cells


def mesh_of(points, cells):
    mesh, vtk_points, polys = vtkPolyData(), vtkPoints(), vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, "f4"), deep=1))
    polys.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(cells) + 1, 3), deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells.ravel(), "i8"), deep=1))
    mesh.SetPoints(vtk_points)
    mesh.SetPolys(polys)
    return mesh


def write(mesh, name):
    writer = vtkPLYWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(name)
    writer.SetFileTypeToBinary()
    writer.Write()


def by_vtk(name, out, vertices):
    mesh = read(name)
    decimation = vtkQuadricDecimation()
    decimation.SetInputData(mesh)
    decimation.SetTargetReduction(1.0 - vertices / mesh.GetNumberOfPoints())
    decimation.Update()
    write(decimation.GetOutput(), out)


def by_meshoptimizer(name, out, vertices):
    points, cells = arrays(read(name))
    library = ctypes.CDLL("libmeshoptimizer.so")
    library.meshopt_simplify.restype = ctypes.c_size_t
    single = np.ascontiguousarray(points, "f4")
    corners = np.ascontiguousarray(cells, "u4").ravel()
    left, error = np.empty_like(corners), ctypes.c_float()
    pointer = lambda array: array.ctypes.data_as(ctypes.c_void_p)
    count = library.meshopt_simplify(
        pointer(left), pointer(corners), ctypes.c_size_t(len(corners)), pointer(single),
        ctypes.c_size_t(len(points)), ctypes.c_size_t(12),
        ctypes.c_size_t(int(len(corners) * vertices / len(points))), ctypes.c_float(1e9),
        ctypes.c_uint(0), ctypes.byref(error))
    used, numbers = np.unique(left[:count], return_inverse=True)
    write(mesh_of(points[used], numbers.reshape(-1, 3)), out)


def samples(points, cells):
    """Points spread evenly over the surface, the same for the same mesh."""
    random = np.random.default_rng(1)
    a, b, c = (points[cells[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(cells), SAMPLES, p=areas / areas.sum())
    u, v = random.random((2, SAMPLES, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]


def distances(points, surface):
    locator, at = vtkStaticCellLocator(), [0.0, 0.0, 0.0]
    locator.SetDataSet(surface)
    locator.BuildLocator()
    cell, sub, squared = reference(0), reference(0), reference(0.0)
    found = np.empty(len(points))
    for k, point in enumerate(points):
        locator.FindClosestPoint(point, at, cell, sub, squared)
        found[k] = squared.get()
    return np.sqrt(found)


def odd_edges(cells):
    """Edges of more than two triangles, and those of two that are wound against each other."""
    edges = np.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]])
    keys = edges.min(1) * (cells.max() + 1) + edges.max(1)
    _, inverse, counts = np.unique(keys, return_inverse=True, return_counts=True)
    turns = np.bincount(inverse, np.where(edges[:, 0] < edges[:, 1], 1, -1))
    return int((counts > 2).sum()), int(((counts == 2) & (turns != 0)).sum())


def measured(command):
    """Processor seconds and peak MiB of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    script = ("import resource,subprocess,sys;r=subprocess.call(sys.argv[1:]);"
              "u=resource.getrusage(resource.RUSAGE_CHILDREN);print(u.ru_maxrss/1024);sys.exit(r)")
    done = subprocess.run([sys.executable, "-c", script, *map(str, command)], check=True,
                          capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, float(done.stdout.split()[-1])


def compare(smg, name, wanted, folder):
    before = read(name)
    points, cells = arrays(before)
    vertices = int(wanted if wanted >= 1 else wanted * len(points))
    diagonal = np.linalg.norm(points.max(0) - points.min(0))
    stream, out = os.path.join(folder, "mesh.vsm"), os.path.join(folder, "out.ply")
    subprocess.run([smg, "convert", name, stream, "--quiet"], check=True)
    print(f"\n{os.path.basename(name)}, {len(points)} vertices, {len(cells)} triangles, to {vertices}: {odd_edges(cells)}\n")
    print("| | vertices | CPU s | MiB | mean % | largest % | edges of > 2 | turned |\n|---|---|---|---|---|---|---|---|")
    own = [smg, "simplify", stream, out, "--vertices", vertices, "--quiet", "--report", os.path.join(folder, "r.json")]
    other = [sys.executable, __file__, "--by"]
    for title, command in (("`smg simplify`", own),
                           ("vtkQuadricDecimation", [*other, "vtk", name, out, vertices]),
                           ("meshoptimizer", [*other, "meshoptimizer", name, out, vertices])):
        seconds, mebibytes = measured(command)
        after = read(out)
        small, triangles = arrays(after)
        there, back = distances(samples(points, cells), after), distances(samples(small, triangles), before)
        mean, largest = (100 * f / diagonal for f in ((there.mean() + back.mean()) / 2, max(there.max(), back.max())))
        branching, turned = odd_edges(triangles)
        print(f"| {title} | {len(small)} | {seconds:.1f} | {mebibytes:.0f} | {mean:.4f} | {largest:.3f} | {branching} | {turned} |", flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "--by":
        _, _, code, source, result, number = sys.argv
        (by_vtk if code == "vtk" else by_meshoptimizer)(source, result, int(number))
    else:
        with tempfile.TemporaryDirectory() as place:
            for mesh in sys.argv[3:]:
                compare(sys.argv[1], mesh, float(sys.argv[2]), place)
