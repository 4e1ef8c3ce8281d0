#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how a solve moves over its levels, from what the program says of itself:

passes.py PROGRAMS TRACE.csv FOLDER

FOLDER/cursors.png: the nodes of each level in memory, and the cursors of some stages, by step of the
first two passes; from the trace of a solve (Examples/Passes writes that of the bunny).
FOLDER/hierarchy.png: a corner of a small mesh, with C-points and the coarse level, what a coarse
node receives in restriction, and what F-points take in prolongation; from the table of the program
`hierarchy` in the folder PROGRAMS."""

import csv
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation

ORANGE, BLUE, GREEN, GREY = "#e8963c", "#3d6ea8", "#2f7d3a", "#9a9a9a"
SHOWN = {  # stages whose cursors are drawn, by pass
    1: {"assemble rows": GREEN, "pack rows": BLUE, "restrict the residual": "black"},
    2: {"relax after prolongation, 2": GREEN, "relax before restriction, 2": BLUE,
        "restrict the residual": "black"}}


def rows_of(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


def draw_cursors(trace, out):
    rows = [row for row in rows_of(trace) if int(row["pass"]) <= 2]
    levels = 1 + max(int(row["level"]) for row in rows if row["stage"] == "in memory")
    steps = {p: max(int(row["step"]) for row in rows if int(row["pass"]) == p) for p in (1, 2)}
    figure, axes = plt.subplots(levels, 2, figsize=(10, 1.9 * levels), sharey="row", squeeze=False,
                                constrained_layout=True)
    for p in (1, 2):
        for level in range(levels):
            curves = {}
            for row in rows:
                if int(row["pass"]) == p and int(row["level"]) == level:
                    curve = curves.setdefault(row["stage"], {})
                    curve[int(row["step"])] = int(row["first"]), int(row["end"])
            axis = axes[level][p - 1]
            x = np.arange(steps[p] + 1)
            held = {}
            for stage, curve in curves.items():
                now, values = (0, 0), []
                for step in x:
                    now = curve.get(step, now)
                    values.append(now)
                held[stage] = np.array(values)
            if "in memory" not in held:  # in memory as a whole
                axis.set_axis_off()
                continue
            window = held["in memory"]
            axis.fill_between(x, window[:, 0], window[:, 1], color=ORANGE, alpha=0.45, linewidth=0,
                              label="in memory")
            for stage, colour in SHOWN[p].items():
                if stage in held:
                    axis.plot(x, held[stage][:, 1], color=colour, linewidth=1.2, label=stage)
            axis.margins(0)
            if p == 1:
                axis.set_ylabel("nodes of level %d" % level)
            if level == 0:
                axis.set_title("first pass" if p == 1 else "second pass")
                axis.legend(fontsize=8, loc="upper left", frameon=False)
            if level == levels - 1:
                axis.set_xlabel("step")
    figure.savefig(out, dpi=110)


def corner(programs, folder):
    """A small plane mesh in stream order: its points, and its hierarchy's first level as
    {relation: {node: [(other, weight)]}}."""
    random = np.random.default_rng(5)
    x, y = np.meshgrid(np.arange(9.0), np.arange(7.0))
    points = np.column_stack([(x + 0.5 * (y % 2)).ravel(), 0.87 * y.ravel()])
    points += random.uniform(-0.22, 0.22, points.shape)
    triangles = Triangulation(points[:, 0], points[:, 1]).triangles
    sides = points[triangles] - points[np.roll(triangles, 1, axis=1)]
    triangles = triangles[np.linalg.norm(sides, axis=2).max(axis=1) < 1.6]  # none along the border
    mesh, stream, ordered, table = (os.path.join(folder, name) for name in
                                    ("corner.obj", "corner.vsm", "ordered.obj", "hierarchy.csv"))
    with open(mesh, "w") as file:  # heights where the problem of the program prescribes nothing
        file.writelines("v %.9g %.9g 0\n" % (0.01 * px, 0.05 + 0.01 * py) for px, py in points)
        file.writelines("f %d %d %d\n" % tuple(corners + 1) for corners in triangles)
    smg = os.path.join(programs, "smg")
    for command in ([smg, "convert", mesh, stream, "--quiet"],
                    [smg, "convert", stream, ordered, "--order", "keep", "--quiet"],
                    [os.path.join(programs, "hierarchy"), stream, table]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with open(ordered) as file:
        read = [line.split() for line in file]
    points = np.array([[float(n) for n in line[1:3]] for line in read if line and line[0] == "v"])
    levels = {}
    for row in rows_of(table):
        of = levels.setdefault(int(row["level"]), {}).setdefault(row["relation"], {})
        of.setdefault(int(row["node"]), []).append((int(row["other"]), float(row["weight"])))
    return points, levels


def draw_hierarchy(programs, out):
    with tempfile.TemporaryDirectory() as folder:
        points, levels = corner(programs, folder)
    fine = levels[0]
    edges = {tuple(sorted((i, j))) for i, row in fine["edge"].items() for j, _ in row}
    vertex = {row[0][0]: i for i, row in fine["C-point"].items()}  # of each coarse node
    coarse_edges = {tuple(sorted((c, d))) for c, row in levels.get(1, {}).get("edge", {}).items()
                    for d, _ in row}
    chosen = sorted(vertex, key=lambda c: np.hypot(*(points[vertex[c]] - points.mean(axis=0))))[0]

    figure, axes = plt.subplots(2, 2, figsize=(11, 9), constrained_layout=True)

    def base(axis, title, faint):
        for i, j in edges:
            axis.plot(*points[[i, j]].T, color=GREY, linewidth=0.5 if faint else 0.9, zorder=1)
        axis.set_title(title, fontsize=10)
        axis.set_aspect("equal")
        axis.axis("off")

    def dots(axis, nodes, colour, size):
        axis.scatter(*points[list(nodes)].T, s=size, color=colour, zorder=3, edgecolors="white")

    def number(axis, nodes, labels, colour="white"):
        for node, label in zip(nodes, labels):
            axis.annotate(str(label), points[node], ha="center", va="center", fontsize=6.5, color=colour,
                          zorder=4)

    everyone, coarse = range(len(points)), sorted(vertex.values())
    base(axes[0][0], "the mesh, and the order of the stream", False)
    dots(axes[0][0], everyone, BLUE, 130)
    number(axes[0][0], everyone, everyone)
    base(axes[0][1], "C-points (orange) become the nodes of the next level, in their order", True)
    for c, d in coarse_edges:
        axes[0][1].plot(*points[[vertex[c], vertex[d]]].T, color=ORANGE, linewidth=1.4, zorder=2)
    dots(axes[0][1], [i for i in everyone if i not in set(coarse)], BLUE, 35)
    dots(axes[0][1], coarse, ORANGE, 150)
    number(axes[0][1], coarse, [c for _, c in sorted((v, c) for c, v in vertex.items())])
    base(axes[1][0], "restriction: what coarse node %d receives" % chosen, True)
    base(axes[1][1], "prolongation: what F-points take; widths are weights", True)
    for i, row in fine["takes"].items():
        for c, weight in row:
            for axis, shown in ((axes[1][0], c == chosen), (axes[1][1], True)):
                if shown:
                    ends = points[[i, vertex[c]]] if axis is axes[1][0] else points[[vertex[c], i]]
                    axis.annotate("", ends[1], ends[0], zorder=2, arrowprops={
                        "arrowstyle": "-|>", "color": GREEN if weight > 0 else "crimson", "shrinkB": 5,
                        "linewidth": 0.4 + 3 * abs(weight), "mutation_scale": 9})
    for axis in axes[1]:
        dots(axis, [i for i in everyone if i not in set(coarse)], BLUE, 35)
        dots(axis, coarse, ORANGE, 90)
    figure.savefig(out, dpi=110)


def main():
    programs, trace, folder = sys.argv[1:]
    draw_cursors(trace, os.path.join(folder, "cursors.png"))
    draw_hierarchy(programs, os.path.join(folder, "hierarchy.png"))


main()
