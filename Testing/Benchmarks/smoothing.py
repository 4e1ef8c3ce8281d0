#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""smoothing.py SMG MESH... : smoothing beside vtkWindowedSincPolyDataFilter and an implicit step in core.

Adds noise of 0.2 mean edges to the points of a cube and of each mesh (.ply or .obj of triangles), smooths it with
`SMG smooth`, with VTK and, as the PMP library does, by one implicit step with a sparse factorization in core
(SciPy's SuperLU), scaled to the volume before; and prints a table: the processor time of the smoothing, from a .vsm file to a .vsm
file and from memory to memory; the peak memory of the processes; and how far the surface is from the mesh
without noise: the root mean square of the distances of the points along its normals, in mean edges, and the
mean angle between the normals of the triangles. Needs VTK, NumPy and SciPy. Files go to the current folder.
"""

import json
import pathlib
import subprocess
import sys
import time

import numpy as np

NOISE = 0.2
SMG_OPTIONS = ([], ["--steps", "3"], ["--steps", "5", "--keep-edges", "30"])
CUBE_OPTIONS = (["--steps", "5", "--size", "8edges"],
                ["--steps", "5", "--size", "8edges", "--keep-edges", "30"])
CUBE_EDGES = 24  # along a side
VTK_OPTIONS = ((20, 0.1), (20, 0.05))
IMPLICIT_EDGES = 4.0  # the default of smg


def read(path):
    """Points and triangles in the order of the file, by VTK."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkOBJReader
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = vtkPLYReader() if path.suffix == ".ply" else vtkOBJReader()
    reader.SetFileName(str(path))
    reader.Update()
    mesh = reader.GetOutput()
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData()).astype(float), triangles


def cube(n):
    """The surface of a cube with n squares along a side, each cut into two triangles."""
    places, triangles = {}, []
    for axis in range(3):
        for side in (0, n):
            for i, j in np.ndindex(n, n):
                corners = []
                for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    point = [0, 0, 0]
                    point[axis], point[axis - 2], point[axis - 1] = side, i + di, j + dj
                    corners.append(places.setdefault(tuple(point), len(places)))
                a, b, c, d = corners if side else corners[::-1]
                triangles += [(a, b, c), (a, c, d)]
    return np.array(list(places), float), np.array(triangles)


def write(path, points, triangles):
    """A binary PLY file in double precision."""
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\n"
                    "property double y\nproperty double z\nelement face %d\n"
                    "property list uchar int vertex_indices\nend_header\n"
                    % (len(points), len(triangles))).encode())
        file.write(np.ascontiguousarray(points, "<f8").tobytes())
        faces = np.zeros(len(triangles), [("n", "u1"), ("corners", "<i4", 3)])
        faces["n"], faces["corners"] = 3, triangles
        file.write(faces.tobytes())


def read_points(path, count):
    """The points of such a file."""
    data = pathlib.Path(path).read_bytes()
    begin = data.index(b"end_header\n") + len(b"end_header\n")
    return np.frombuffer(data, "<f8", 3 * count, begin).reshape(-1, 3)


def area_vectors(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a) / 2


class Original:
    """A mesh without noise."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles
        self.areas = area_vectors(points, triangles)
        ends = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        self.edge = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1).mean()
        self.normals = np.zeros_like(points)
        for k in range(3):
            np.add.at(self.normals, triangles[:, k], self.areas)
        self.normals /= np.maximum(np.linalg.norm(self.normals, axis=1, keepdims=True), 1e-300)

    def errors(self, points):
        """Distance in mean edges, angle in degrees, relative volume."""
        along = np.einsum("ij,ij->i", points - self.points, self.normals) / self.edge
        areas = area_vectors(points, self.triangles)
        size = np.linalg.norm(areas, axis=1) * np.linalg.norm(self.areas, axis=1)
        cosine = np.einsum("ij,ij->i", areas, self.areas)[size > 0] / size[size > 0]
        angle = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
        return np.sqrt(np.mean(along**2)), angle.mean(), self.volume(points) / self.volume(self.points)

    def volume(self, points):
        corners = points[self.triangles] - self.points[0]
        return np.einsum("ij,ij", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6


def peak_bytes():
    # Not ru_maxrss, which a child inherits from its parent.
    with open("/proc/self/status", encoding="utf-8") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])
    return 0


def smooth_with_vtk(source, result, iterations, band):
    """In a process of its own, whose peak memory counts."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = vtkPLYReader()
    reader.SetFileName(source)
    reader.Update()
    smoothing = vtkWindowedSincPolyDataFilter()
    smoothing.SetInputData(reader.GetOutput())
    smoothing.SetNumberOfIterations(iterations)
    smoothing.SetPassBand(band)
    smoothing.NormalizeCoordinatesOn()
    begin = time.process_time()
    smoothing.Update()
    seconds = time.process_time() - begin
    np.save(result, vtk_to_numpy(smoothing.GetOutput().GetPoints().GetData()))
    print(json.dumps({"seconds": seconds, "bytes": peak_bytes()}))


def smooth_implicitly(source, result, count, edges):
    """One step that halves waves of this many mean edges, in a process of its own."""
    from scipy import sparse
    from scipy.sparse.linalg import splu

    points, triangles = read(pathlib.Path(source))
    assert len(points) == count
    begin = time.process_time()
    original = Original(points, triangles)
    twice = 2 * np.linalg.norm(original.areas, axis=1)
    mass = sum(np.bincount(triangles[:, k], twice / 6, count) for k in range(3))
    rows, columns, values = [], [], []
    for k in range(3):
        at, a, b = triangles[:, k], triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
        cosine = np.einsum("ij,ij->i", points[a] - points[at], points[b] - points[at])
        weight = cosine / np.maximum(twice, 1e-300) / 2
        rows += [a, b, a, b]
        columns += [b, a, a, b]
        values += [-weight, -weight, weight, weight]
    stiffness = sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                  (count, count))
    mass[mass == 0] = 1  # vertices of no triangle
    step = (edges * original.edge / (2 * np.pi)) ** 2
    factor = splu(sparse.diags(mass, format="csc") + step * stiffness, permc_spec="MMD_AT_PLUS_A",
                  diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    smooth = factor.solve(mass[:, None] * points)
    center = mass @ smooth / mass.sum()
    scale = (original.volume(points) / original.volume(smooth)) ** (1 / 3)
    smooth = center + scale * (smooth - center)
    seconds = time.process_time() - begin
    np.save(result, smooth)
    print(json.dumps({"seconds": seconds, "bytes": peak_bytes()}))


def measure(smg, name, points, triangles, smg_options):
    original = Original(points, triangles)
    noise = np.random.default_rng(1).normal(size=points.shape) * NOISE * original.edge
    write("noisy.ply", points + noise, triangles)
    subprocess.run([smg, "convert", "noisy.ply", "noisy.vsm", "--quiet"], check=True)
    print(f"\n{name}, {len(points)} vertices, {len(triangles)} triangles:\n")
    print("| | CPU s | MiB | distance | angle | volume |\n|---|---|---|---|---|---|")

    def row(name, seconds, size, errors):
        cells = (f"{seconds:.1f}", f"{size / 2**20:.0f}") if size else ("", "")
        distance, angle, volume = errors
        print(f"| {name} | {cells[0]} | {cells[1]} | {distance:.3f} | {angle:.1f} | {volume:.5f} |",
              flush=True)

    row("with noise", 0, 0, original.errors(points + noise))
    for options in smg_options:
        subprocess.run([smg, "smooth", "noisy.vsm", "smooth.vsm", "--quiet", "--report", "report.json",
                        "--tolerance", "1e-6", *options], check=True)
        subprocess.run([smg, "convert", "smooth.vsm", "smooth.ply", "--restore-order", "--quiet"],
                       check=True)
        report = json.loads(pathlib.Path("report.json").read_text(encoding="utf-8"))
        row(" ".join(["smg smooth", *options]), report["cpu_seconds"], report["rss_bytes_peak"],
            original.errors(read_points("smooth.ply", len(points))))
    others = [(f"windowed sinc, {iterations} iterations, pass band {band}", "--vtk", iterations, band)
              for iterations, band in VTK_OPTIONS]
    others.append(("an implicit step in core", "--implicit", len(points), IMPLICIT_EDGES))
    for name, *arguments in others:
        done = subprocess.run([sys.executable, __file__, arguments[0], "noisy.ply", "smooth.npy",
                               *map(str, arguments[1:])], check=True, capture_output=True, text=True)
        numbers = json.loads(done.stdout)
        row(name, numbers["seconds"], numbers["bytes"],
            original.errors(np.load("smooth.npy").astype(float)))


if __name__ == "__main__":
    if sys.argv[1] == "--vtk":
        smooth_with_vtk(sys.argv[2], sys.argv[3], int(sys.argv[4]), float(sys.argv[5]))
    elif sys.argv[1] == "--implicit":
        smooth_implicitly(sys.argv[2], sys.argv[3], int(sys.argv[4]), float(sys.argv[5]))
    else:
        measure(sys.argv[1], "cube", *cube(CUBE_EDGES), CUBE_OPTIONS)
        for mesh in map(pathlib.Path, sys.argv[2:]):
            measure(sys.argv[1], mesh.name, *read(mesh), SMG_OPTIONS)
