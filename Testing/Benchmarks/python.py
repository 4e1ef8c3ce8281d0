#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""python.py SMG [VERTICES] : solving from arrays in Python beside the command line, SciPy and PyAMG.

A torus of about VERTICES (1000000) vertices, whose density f is the first coordinate less its mean, with
u = 0 at one vertex; and 2.77 million unless VERTICES is given. Each row is a process of its own, and the
table has its processor time from the arrays (of the command line from a .ply file) to the solution, its
wall-clock time, its peak memory above that of the arrays, and how far the solution is from that of the
first row, in the range of the solution. SciPy factorizes the matrix (SuperLU); PyAMG, where it is
installed, has the matrix already, whose assembly by NumPy is not counted. Needs the package
streamingmultigrid (PYTHONPATH), NumPy and SciPy. Files go to the current folder.
"""

import importlib.util
import json
import resource
import subprocess
import sys
import time

import numpy as np

WAYS = ("in core", "out of core", "out of core, 128 MB", "kept hierarchy", "command line, in core",
        "SciPy, direct", "PyAMG")  # fmt: skip
TOLERANCE = 1e-8


def torus(vertices):
    """Points (n, 3) and triangles (m, 3)."""
    n = round((vertices / 2) ** 0.5)
    u, v = np.meshgrid(np.arange(2 * n), np.arange(n), indexing="ij")
    a, b = 2 * np.pi * u.ravel() / (2 * n), 2 * np.pi * v.ravel() / n
    points = np.stack([(1 + 0.4 * np.cos(b)) * np.cos(a), (1 + 0.4 * np.cos(b)) * np.sin(a), 0.4 * np.sin(b)], 1)
    number = lambda i, j: ((i % (2 * n)) * n + j % n).ravel()  # noqa: E731
    p, q, r, s = number(u, v), number(u + 1, v), number(u + 1, v + 1), number(u, v + 1)
    return points, np.concatenate([np.stack([p, q, r], 1), np.stack([p, r, s], 1)])


def areas_and_load(points, triangles, source):
    """The areas of the triangles, and the load of linear elements."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return area, np.bincount(triangles.ravel(), np.repeat(area / 3, 3), len(points)) * source


def system(points, triangles, source):
    """The stiffness (sparse) and load of linear elements, with u = 0 at vertex 0."""
    from scipy.sparse import coo_matrix

    corners = points[triangles]
    area, load = areas_and_load(points, triangles, source)
    rows, columns, values = [], [], []
    for k in range(3):
        i, j = triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
        a, b = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        weight = np.einsum("ij,ij->i", a, b) / (4 * area)
        for x, y, w in ((i, j, -weight), (j, i, -weight), (i, i, weight), (j, j, weight)):
            rows.append(x), columns.append(y), values.append(w)
    n = len(points)
    matrix = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (n, n)).tocsc()
    return matrix[1:, 1:], load[1:]


def solve(way, vertices, smg_program):
    """The solution, and what is not counted: processor seconds and wall-clock seconds."""
    points, triangles = torus(vertices)
    source = points[:, 0] - points[:, 0].mean()
    if way == "command line, in core":
        with open("torus.ply", "wb") as file:
            file.write(
                b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
                b"property double z\nproperty double f\nelement face %d\nproperty list uchar int vertex_indices\n"
                b"end_header\n" % (len(points), len(triangles)))  # fmt: skip
            file.write(np.column_stack([points, source]).tobytes())
            faces = np.empty(len(triangles), [("n", "u1"), ("corners", "<i4", 3)])
            faces["n"], faces["corners"] = 3, triangles
            file.write(faces.tobytes())
        with open("torus.json", "w", encoding="utf-8") as file:
            json.dump({"source": "f", "dirichlet": [{"vertices": [0], "value": 0}]}, file)
        begin = time.time()
        subprocess.run([smg_program, "solve", "torus.ply", "torus.vtu", "--problem", "torus.json", "--in-core",
                        "--quiet", "--report", "torus-report.json"], check=True)  # fmt: skip
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return None, used.ru_utime + used.ru_stime, time.time() - begin, 1024 * used.ru_maxrss
    if way in ("SciPy, direct", "PyAMG"):
        from scipy.sparse.linalg import splu

        matrix, load = system(points, triangles, source)
        if way == "PyAMG":
            import pyamg
        before, begin, cpu = forget_peak(), time.time(), time.process_time()
        if way == "PyAMG":
            values = pyamg.smoothed_aggregation_solver(matrix.tocsr()).solve(load, tol=TOLERANCE, accel="cg")
        else:
            values = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(load)
        values = np.concatenate([[0.0], values])
    else:
        import streamingmultigrid as smg

        load = None
        if way == "kept hierarchy":
            _, load = areas_and_load(points, triangles, source)
            load[0] = 0  # the prescribed value
        before, begin, cpu = forget_peak(), time.time(), time.process_time()
        if way == "kept hierarchy":
            solver = smg.solver(points, triangles, dirichlet={0: 0.0})
            begin, cpu = time.time(), time.process_time()  # what a further right-hand side takes
            values = solver.solve(load, tol=TOLERANCE)
        else:
            options = {"in core": {"in_core": True}, "out of core": {}}.get(way, {"memory": "128MB"})
            values = smg.solve(points, triangles, source=source, dirichlet={0: 0.0}, tolerance=TOLERANCE, **options)
    return values, time.process_time() - cpu, time.time() - begin, resident("VmHWM") - before


def resident(name):
    """VmRSS or, since forget_peak(), VmHWM of this process, bytes."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(name))


def forget_peak():
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")
    return resident("VmRSS")


def main():
    if len(sys.argv) == 4:
        values, cpu, wall, memory = solve(sys.argv[3], int(sys.argv[2]), sys.argv[1])
        if values is not None:
            np.save("solution.npy", values)
        print(json.dumps({"cpu": cpu, "wall": wall, "memory": memory, "solved": values is not None}))
        return
    ways = WAYS if importlib.util.find_spec("pyamg") else WAYS[:-1]
    for vertices in [int(sys.argv[2])] if len(sys.argv) > 2 else [1_000_000, 2_770_000]:
        print("\n| %d vertices | CPU s | wall s | MiB | difference |\n|---|---|---|---|---|" % len(torus(vertices)[0]))
        first = None
        for way in ways:
            done = subprocess.run([sys.executable, __file__, sys.argv[1], str(vertices), way],
                                  capture_output=True, text=True)  # fmt: skip
            if done.returncode:
                print("| %s | %s | | | |" % (way, done.stderr.strip().splitlines()[-1][:60]), flush=True)
                continue
            row, difference = json.loads(done.stdout.splitlines()[-1]), ""
            if row["solved"]:
                values = np.load("solution.npy")
                first = values if first is None else first
                difference = "%.1e" % (np.abs(values - first).max() / np.ptp(first))
            print("| %s | %.1f | %.1f | %.0f | %s |" % (
                way, row["cpu"], row["wall"], row["memory"] / 2**20, difference), flush=True)  # fmt: skip


main()
