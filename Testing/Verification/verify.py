#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""verify.py SMG [--table FILE.md] [--tolerance 1e-10] MESH... : smg beside independent finite elements.

Every problem of cases.py is solved by smg with its default weights and directly (reference.py), on
each mesh, a file of any format that smg reads. Printed are V-cycles, the largest error in % of the
range of the solution, and by how much the fluxes and sources miss a balance of zero. Fails where an
error exceeds 1e-4 %, a balance the tolerance, or smg says that it has not converged.
"""
import argparse
import os
import sys
import tempfile
import time

import numpy as np

from cases import Domain
from reference import Reference
from streamed_mesh import StreamedMesh, read_with_smg

MOST_ERROR = 1e-4  # in % of the range


class Row:
    """What came out of a case on a mesh."""

    def __init__(self, case, solution, answer):
        self.name, self.report = case.name, solution.report
        scale = case.scale or np.ptp(answer.u)
        self.error = 100 * np.nanmax(np.abs(solution.u - answer.u)) / scale
        self.balance = imbalance(solution.report, answer)
        self.conditions = condition_error(solution.report, answer)

    def failures(self, tolerance):
        if not self.report["converged"]:
            yield "not converged"
        if not self.error <= MOST_ERROR:
            yield f"error {self.error:.1e} %"
        if self.balance is not None and not self.balance <= tolerance:
            yield f"balance {self.balance:.1e}"

    def __str__(self):
        balance = "-" if self.balance is None else f"{self.balance:.1e}"
        return f"{self.report['cycles']:4d} {self.error:9.1e} {balance:>9}"


def imbalance(report, answer):
    """The sum of all that flows in, over its magnitudes; None if nothing flows or nothing is said."""
    if not report.get("conditions") or not np.max(answer.traffic) > 0.0:
        return None
    total = answer.source + sum(np.ravel(each["flux"]) for each in report["conditions"])
    return np.max(np.abs(total)) / np.max(answer.traffic)


def condition_error(report, answer):
    """The largest difference of areas, means and fluxes from the answer's, over the largest of each."""
    worst = 0.0
    for each in report.get("conditions", []):
        expected = answer.conditions[each["name"]]
        for said, value, scale in (
                (each["area"], expected.area, expected.area),
                (each["mean"], expected.mean, np.max(np.abs(answer.u))),
                (each["flux"], expected.flux, np.max(answer.traffic))):
            if scale > 0.0 and np.all(np.isfinite(value)):
                worst = max(worst, np.max(np.abs(np.ravel(said) - value)) / scale)
    return worst


def verify(program, name, tolerance):
    """Prints and answers the Rows of a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        domain = Domain(*read_with_smg(program, folder, name))
        columns = domain.vertex_columns, domain.cell_columns
        mesh = StreamedMesh(program, folder, domain.points, domain.cells, *columns)
        reference = Reference(domain.points, domain.cells, *columns)
        print(f"{os.path.basename(name)}: {len(domain.points)} vertices, {len(domain.cells)} "
              f"{'triangles' if domain.cells.shape[1] == 3 else 'tetrahedra'}", flush=True)
        rows = []
        for case in domain.cases():
            try:
                row = Row(case, mesh.solve(case.problem, tolerance), reference.solve(case.problem))
            except RuntimeError as error:
                print(f"  {case.name:26} {error}", flush=True)
                continue
            print(f"  {case.name:26} {row}", *row.failures(tolerance), flush=True)
            rows.append(row)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--tolerance", type=float, default=1e-10)
    parser.add_argument("mesh", nargs="+")
    options = parser.parse_args()
    for name in options.mesh:
        verify(options.program, name, options.tolerance)


if __name__ == "__main__":
    main()
