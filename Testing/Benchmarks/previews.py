#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Previews of noisy surfaces: how many points they have, whether they are manifold, and how far a solution on
them is off.

PYTHONPATH=BUILD/lib/python3/dist-packages python3 previews.py SMG MESH...: for each mesh and number of points a row in Markdown: the
points of the preview, its edges of more than two triangles and those whose triangles are wound against each other, how far the
solution of the Laplace equation between 0 and 1, at the 3 % of the points with the least and the largest z, is off at its points
(mean, and 99 %), and the processor time for a triangle of the mesh. gyroid:N:NOISE:SEED instead of a MESH is the isosurface of a gyroid with
noise that is sampled N^3 times, by vtkFlyingEdges3D."""

import os
import resource
import subprocess
import sys
import tempfile
import warnings

import numpy as np
import streamingmultigrid as smg
from scipy.spatial import cKDTree

POINTS = (5000, 10000, 15000, 100000)


def gyroid(n, noise, seed, out):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk

    x = np.linspace(0, 6 * np.pi, n, dtype="f4")
    s, c = np.sin(x), np.cos(x)
    values = s * c[:, None] + s[:, None] * c[:, None, None] + s[:, None, None] * c
    values = values + noise * np.random.default_rng(seed).normal(size=values.shape).astype("f4")
    image = vtk.vtkImageData()
    image.SetDimensions(n, n, n)
    image.SetSpacing(1 / (n - 1), 1 / (n - 1), 1 / (n - 1))
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=1))
    edges = vtk.vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0)
    edges.ComputeNormalsOff()
    writer = vtk.vtkPLYWriter()
    writer.SetInputConnection(edges.GetOutputPort())
    writer.SetFileName(out)
    writer.Write()


def wrong_edges(triangles, vertices):
    """Edges of more than two triangles, and of two that run along it in the same direction."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    edges, counts = np.unique(ends.min(1) * vertices + ends.max(1), return_counts=True)
    directed, along = np.unique(ends[:, 0] * vertices + ends[:, 1], return_counts=True)
    twice = directed[along > 1]
    low, high = np.minimum(twice // vertices, twice % vertices), np.maximum(twice // vertices, twice % vertices)
    return int((counts > 2).sum()), int(np.isin(low * vertices + high, edges[counts == 2]).sum())


def solution(mesh, low, high):
    return mesh.solve(dirichlet=[smg.below(z=low) >> 0, smg.above(z=high) >> 1]).to_numpy()


def measure(program, name, folder):
    if name.startswith("gyroid:"):
        n, noise, seed = name.split(":")[1:]
        name = os.path.join(folder, "gyroid%s.ply" % n)
        gyroid(int(n), float(noise), int(seed), name)
    stream = os.path.join(folder, "mesh.vsm")
    subprocess.run([program, "convert", name, stream, "--quiet"], check=True)
    mesh = smg.open(stream)
    points = mesh.points
    low, high = np.percentile(points[:, 2], [3, 97])
    exact, places = solution(mesh, low, high), cKDTree(points)
    for number in POINTS:
        out = os.path.join(folder, "preview.ply")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "preview", stream, out, "--points", str(number), "--quiet"], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        preview = smg.open(out)
        off = np.abs(solution(preview, low, high) - exact[places.query(preview.points)[1]])
        off = off[np.isfinite(off)]
        wrong = wrong_edges(np.asarray(preview.cells), len(preview.points))
        print("| %s | %d | %d | %d | %d | %.4f, %.4f | %.2f |" % (
            os.path.basename(name), number, len(preview.points), *wrong, off.mean(), np.percentile(off, 99),
            1e6 * seconds / mesh.n_cells), flush=True)


warnings.simplefilter("ignore")
print("| mesh | asked for | points | edges of > 2 | turned | Poisson off: mean, 99 % | us a triangle |\n|---|---|---|---|---|---|---|")
with tempfile.TemporaryDirectory() as place:
    for argument in sys.argv[2:]:
        measure(sys.argv[1], argument, place)
