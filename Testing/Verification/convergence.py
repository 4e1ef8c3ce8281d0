#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""convergence.py SMG [--out FOLDER] : orders of convergence of smg towards known solutions.

Each problem of manufactured.py is solved on four meshes, each of half the size of the one before. Fails
unless the error of u in L2 decreases with an order of at least 1.8 and that of its gradient with 0.9,
from each mesh to the next. Writes convergence.md and convergence.svg to FOLDER.
"""
import argparse
import os
import sys
import tempfile
from typing import NamedTuple

import numpy as np

import manufactured
from finite_elements import FiniteElements
from streamed_mesh import StreamedMesh

LEAST_ORDERS = (1.8, 0.9)  # of u, of its gradient


class Errors(NamedTuple):
    """On one mesh."""
    vertices: int
    size: float      # cells**(-1 / dimension): the size of a cell, up to a factor
    value: float     # || u - u_h || in L2
    gradient: float  # || grad u - grad u_h || in L2
    cycles: int


def quadrature(corners):
    """Barycentric coordinates (points, corners) and weights that sum to 1: exact to degree 4 or more."""
    t, w = np.polynomial.legendre.leggauss(4)
    t, w = (t + 1) / 2, w / 2
    points, weights = np.ones((1, 1)), np.ones(1)
    for dimension in range(1, corners):
        # A simplex is a cone over one of a lower dimension: s = 0 is its apex.
        points = np.concatenate([np.hstack([s * points, np.full((len(points), 1), 1 - s)])
                                 for s in t])
        weights = np.concatenate([dimension * s**(dimension - 1) * v * weights
                                  for s, v in zip(t, w)])
    return points, weights


def errors(study, elements, u, gradient):
    """The L2 norms of the errors of u (vertices,) and its gradient (cells, 3)."""
    value, slope = 0.0, 0.0
    for coordinates, weight in zip(*quadrature(elements.corners)):
        x = study.onto(np.einsum("k,ckd->cd", coordinates, elements.points[elements.cells]))
        measure = weight * elements.measure
        value += measure @ (study.exact(x) - u[elements.cells] @ coordinates)**2
        slope += measure @ np.sum((study.gradient(x) - gradient)**2, axis=1)
    return np.sqrt(value), np.sqrt(slope)


def measure(program, study, n):
    points, cells = study.mesh(n)
    problem, columns = study.problem(points)
    with tempfile.TemporaryDirectory() as folder:
        mesh = StreamedMesh(program, folder, points, cells, columns)
        solution = mesh.solve({**problem, "outputs": ["gradient"]})
    assert solution.report["converged"], (study.name, n, solution.report["notes"])
    elements = FiniteElements(points, cells)
    return Errors(len(points), len(cells)**(-1 / (elements.corners - 1)),
                  *errors(study, elements, solution.u[:, 0], solution.gradient),
                  solution.report["cycles"])


def orders(coarse, fine):
    """Of u and of its gradient, from one mesh to the next."""
    ratio = np.log(coarse.size / fine.size)
    return (np.log(coarse.value / fine.value) / ratio,
            np.log(coarse.gradient / fine.gradient) / ratio)


def table(results):
    lines = ["| problem | vertices | error of u, L2 | order | error of grad u, L2 | order | V-cycles |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, rows in results.items():
        for k, row in enumerate(rows):
            value, slope = (f"{order:.2f}" for order in orders(rows[k - 1], row)) if k else "  "
            lines.append(f"| {name} | {row.vertices} | {row.value:.2e} | {value} | "
                         f"{row.gradient:.2e} | {slope} | {row.cycles} |")
    return "\n".join(lines) + "\n"


def plot(results, name):
    import matplotlib  # needed for the plot only
    matplotlib.use("svg")
    from matplotlib import pyplot
    matplotlib.rcParams["svg.hashsalt"] = "smg"
    figure, sides = pyplot.subplots(1, 2, figsize=(9, 4), sharex=True)
    for side, key, order in zip(sides, ("value", "gradient"), (2, 1)):
        for label, rows in results.items():
            side.loglog([row.size for row in rows], [getattr(row, key) for row in rows], "o-",
                        label=label)
        sizes = np.array([min(row.size for rows in results.values() for row in rows),
                          max(row.size for rows in results.values() for row in rows)])
        top = max(getattr(row, key) for rows in results.values() for row in rows)
        side.loglog(sizes, top * (sizes / sizes[1])**order, "k--", label=f"order {order}")
        side.set_xlabel("size of a cell")
        side.set_title({"value": "error of u in L2", "gradient": "error of grad u in L2"}[key])
        side.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(name, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--out")
    options = parser.parse_args()
    results = {}
    for study in manufactured.ALL:
        results[study.name] = [measure(options.program, study, n) for n in study.refinements]
    print(table(results))
    if options.out:
        with open(os.path.join(options.out, "convergence.md"), "w", encoding="utf-8") as file:
            file.write(table(results))
        plot(results, os.path.join(options.out, "convergence.svg"))
    slow = [name for name, rows in results.items() for pair in zip(rows, rows[1:])
            if any(found < least for found, least in zip(orders(*pair), LEAST_ORDERS))]
    assert not slow, slow
    return 0


if __name__ == "__main__":
    sys.exit(main())
