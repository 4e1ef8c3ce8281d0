#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""verify.py SMG [--json FILE] [--answers FOLDER] [MESH...] : compares smg with independent finite elements.

On each mesh, a file of any format that smg reads, every problem of cases.py is solved by smg with its
default weights and directly (reference.py); without a MESH on generated meshes. Prints V-cycles, the
largest error in % of the range of the solution, the mean error of its columns Gradient and Flux if
requested, the largest error of an area, a mean, a flux or the energy in the report, and the imbalance
of fluxes and sources, over all inflow. Fails if an error exceeds 1e-4 % (or KNOWN_ERRORS), if the
imbalance exceeds the tolerance times the larger of all inflow and the largest sum of a residual with
the norm of the initial one, or if smg does not converge. A MESH that is not a path is one of the archive in SMG_TEST_DATA_DIR;
`archive` stands for all of these. Without an archive it is skipped (77). The direct solutions, which
take most of the time, are stored in FOLDER and reused in the next run.
"""
import argparse
import json
import os
import pickle
import sys
import tempfile
import zlib

try:
    import numpy as np
    import scipy  # pylint: disable=unused-import
except ImportError:
    print("skipped: there is no NumPy and SciPy")
    sys.exit(77)

import meshes
from cases import Domain
from reference import Reference
from streamed_mesh import StreamedMesh, read_with_smg

TOLERANCE = 1e-10
MOST_ERROR = 1e-4  # in %
# Two pairs of vertices, each connected by one sliver, whose weights are in single precision.
KNOWN_ERRORS = {("head_tet336k.vtk", "Robin"): 2e-4}
ARCHIVE = ("armadillo43k.obj", "brain168k.vtk", "bunny.ply", "dragon.ply", "dragon_res3.ply",
           "elephant44k.off", "head_mri_1m.ply", "horse_be.ply", "lucy50k.ply",
           "rangemap_lato315.ply", "armadillo_tet.msh", "bunny_tet.mesh", "head_tet336k.vtk",
           "raptor_tet.vtu")
MADE = {"graded half cylinder": lambda: meshes.half_cylinder(24, 3.0),
        "sphere": lambda: meshes.sphere(20), "flat sphere": lambda: flattened(*meshes.sphere(20)),
        "cube": lambda: meshes.box(12), "ball": lambda: meshes.ball(9),
        "flat ball": lambda: flattened(*meshes.ball(9)),
        "ball of nanometres": lambda: (1e-9 * meshes.ball(7)[0], meshes.ball(7)[1])}


def flattened(points, cells):
    """The mesh at a fifth of its width: some of its cells become slivers."""
    return points * np.array([1.0, 0.2, 1.0]), cells


def imbalance(u, conditions, answer):
    """The sum of all inflow (columns,); None if there are no conditions."""
    if not answer.conditions:
        return None
    total = answer.load.sum(axis=0) - answer.screened @ u
    return np.abs(total + sum(np.array(each["flux"]) for each in conditions.values()))


def share(missing, whole):
    """The largest imbalance of a column as a share of the inflow; None if unknown."""
    return None if missing is None else float(np.max(missing / whole))


def report_error(report, conditions, answer, span):
    """In %: the largest error of areas, of means over the span of the solution, of the energy, and of
    fluxes over all that flows."""
    worst = np.max(np.abs(report["mean"] - answer.mean)) / span
    if np.ptp(answer.u) > 1e-9 * span:  # otherwise it has only the rounding error
        scale = np.maximum(answer.energy, 1e-9 * span * answer.traffic)
        worst = max(worst, np.max(np.abs(report["energy"] - answer.energy) / scale))
    for name, expected in answer.conditions.items():
        said = conditions[name]
        worst = max(worst, np.max(np.abs(said["flux"] - expected.flux) / answer.traffic))
        if expected.area > 0.0:
            worst = max(worst, abs(said["area"] / expected.area - 1),
                        np.max(np.abs(said["mean"] - expected.mean)) / span)
    return 100 * float(worst)


def output_error(solution, answer, measure):
    """In %: the mean error of the gradient and the flux in the cells over their mean; None without."""
    if solution.gradient is None:
        return None
    return 100 * float(max(
        measure @ np.linalg.norm(said - expected, axis=1) / (
            measure @ np.linalg.norm(expected, axis=1))
        for said, expected in ((solution.gradient, answer.gradient), (solution.flux, answer.flux))))


def result(case, solution, answer, measure):
    """The results of a case, the numbers of the table; measure (cells,) are areas or volumes."""
    conditions = {each["name"]: each for each in solution.report["conditions"]}
    span = case.scale or np.ptp(answer.u)
    missing = imbalance(solution.u, conditions, answer)
    difference = np.nanmax(np.abs(solution.u - answer.u))
    return {"case": case.name, "cycles": solution.report["cycles"],
            "converged": solution.report["converged"],
            "error": 100 * float(difference / span),
            "output_error": output_error(solution, answer, measure),
            "report_error": report_error(solution.report, conditions, answer, span),
            "balance": share(missing, answer.traffic),
            "residual": share(missing, np.maximum(answer.traffic, answer.residual))}


def failures(row):
    if "failed" in row:
        return [row["failed"]]
    limits = dict.fromkeys(("error", "output_error", "report_error"), MOST_ERROR)
    limits["error"] = KNOWN_ERRORS.get((row["mesh"], row["case"]), MOST_ERROR)
    limits["residual"] = TOLERANCE
    return ([] if row["converged"] else ["not converged"]) + [
        key for key, most in limits.items() if row[key] is not None and not row[key] <= most]


def line(row):
    if "failed" in row:
        return f"  {row['case']:27} failed: {row['failed']}"
    numbers = " ".join("        -" if row[key] is None else f"{row[key]:9.1e}"
                       for key in ("error", "output_error", "report_error", "balance"))
    return f"  {row['case']:27} {row['cycles']:4d} {numbers}  {', '.join(failures(row))}"


def direct_answer(reference, problem, folder):
    """The Answer to a problem, kept in a folder under the checksum of the mesh and the problem."""
    if folder is None:
        return reference.solve(problem)
    mesh = (reference.elements.points, reference.elements.cells)
    key = repr((*(zlib.crc32(np.ascontiguousarray(each)) for each in mesh), problem))
    name = os.path.join(folder, f"{zlib.crc32(key.encode()):08x}.pickle")
    if os.path.exists(name):
        with open(name, "rb") as file:
            kept, answer = pickle.load(file)
            if kept == key:
                return answer
    answer = reference.solve(problem)
    with open(name, "wb") as file:
        pickle.dump((key, answer), file)
    return answer


def verify(program, name, answers):
    """Prints and returns the results of a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        domain = Domain(*(MADE[name]() if name in MADE else read_with_smg(program, folder, name)))
        columns = domain.vertex_columns, domain.cell_columns
        mesh = StreamedMesh(program, folder, domain.points, domain.cells, *columns)
        reference = Reference(domain.points, domain.cells, *columns)
        kind = "triangles" if domain.cells.shape[1] == 3 else "tetrahedra"
        print(f"{os.path.basename(name)}: {len(domain.points)} vertices, {len(domain.cells)} {kind}\n"
              f"  {'':27} cycles  error % output % report %  balance", flush=True)
        rows = []
        for case in domain.cases():
            try:
                solution = mesh.solve(case.problem, TOLERANCE)
                answer = direct_answer(reference, case.problem, answers)
                rows.append(result(case, solution, answer, reference.elements.measure))
            except RuntimeError as error:
                rows.append({"case": case.name, "failed": str(error)})
            rows[-1]["mesh"] = os.path.basename(name)
            print(line(rows[-1]), flush=True)
    return {"mesh": os.path.basename(name), "vertices": len(domain.points),
            "cells": len(domain.cells), "kind": kind, "results": rows}


def files(names):
    """The names of the meshes to verify."""
    archive = os.environ.get("SMG_TEST_DATA_DIR", "")
    for name in ARCHIVE if names == ["archive"] else names or MADE:
        if name in MADE or os.path.exists(name):
            yield name
        elif archive:
            yield os.path.join(archive, name)
        else:
            print("skipped: SMG_TEST_DATA_DIR names no archive of meshes")
            sys.exit(77)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program")
    parser.add_argument("--json")
    parser.add_argument("--answers")
    parser.add_argument("mesh", nargs="*")
    options = parser.parse_intermixed_args()
    results = [verify(options.program, name, options.answers) for name in files(options.mesh)]
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    return int(any(failures(row) for mesh in results for row in mesh["results"]))


if __name__ == "__main__":
    sys.exit(main())
