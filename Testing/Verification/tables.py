#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""tables.py RESULTS DOCS : writes the measurements into the documentation.

RESULTS is the folder of run.sh: verify.json, convergence.md and .svg, and
peers-TOLERANCE-MESH.json. DOCS/verification receives the table of all errors and the plot; in
DOCS/verification.md the tables between the lines `<!-- NAME -->` and `<!-- end -->` are replaced.
"""
import json
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Support"))
from documented_tables import replace_tables  # noqa: E402


def row(*fields):
    return "| " + " | ".join(map(str, fields)) + " |\n"


def head(*fields):
    return row(*fields) + row(*["---"] * len(fields))


def shown(value):
    return "-" if value is None else f"{value:.0e}"


def largest(results, key):
    values = [each[key] for each in results if each.get(key) is not None]
    return max(values) if values else None


def spread(results):
    """The minimum and maximum of V-cycles, and the number of solves that did not converge."""
    cycles = [each["cycles"] for each in results]
    missing = sum(not each["converged"] for each in results)
    return f"{min(cycles)} - {max(cycles)}" + (f", {missing} not converged" if missing else "")


SUMMARY = ("error, %", "of gradient and flux, %", "of the report, %", "imbalance", "V-cycles")
KEYS = ("error", "output_error", "report_error", "balance")


def summary(results):
    return (*(shown(largest(results, key)) for key in KEYS), spread(results))


def by_mesh(verified):
    text = head("mesh", "vertices", "cells", *SUMMARY)
    for mesh in verified:
        text += row(mesh["mesh"], mesh["vertices"], f"{mesh['cells']} {mesh['kind']}",
                    *summary(mesh["results"]))
    return text


def by_problem(verified):
    cases = {}
    for mesh in verified:
        for each in mesh["results"]:
            cases.setdefault(each["case"], []).append(each)
    text = head("problem", "meshes", *SUMMARY)
    for name, results in cases.items():
        text += row(name, len(results), *summary(results))
    return text


def everything(verified):
    text = head("mesh", "problem", *SUMMARY)
    for mesh in verified:
        for each in mesh["results"]:
            text += row(mesh["mesh"], each["case"], *(shown(each[key]) for key in KEYS),
                        str(each["cycles"]) + ("" if each["converged"] else ", not converged"))
    return text


def our_cycles(measured):
    """V-cycles of smg; in brackets if it has not reached the tolerance."""
    ours = measured["results"]["smg"]
    return str(ours["iterations"]) if ours["converged"] else f"({ours['iterations']})"


def their_iterations(measured):
    """Of hypre, which solves the three columns one by one: per column, likewise."""
    theirs = measured["results"]["hypre"]
    if "failed" in theirs:
        return "fails"
    text = f"{theirs['iterations'] / 3:.0f}"
    return text if theirs["relative_residual"] <= measured["tolerance"] else f"({text})"


def peers(results):
    text = head("mesh", "vertices", "1e-6: V-cycles", "hypre", "1e-10: V-cycles", "hypre")
    for file in sorted(results.glob("peers-1e-6-*.json")):
        usual, accurate = (json.loads(each.read_text()) for each in (
            file, results / file.name.replace("1e-6", "1e-10")))
        text += row(file.stem.removeprefix("peers-1e-6-"), usual["vertices"],
                    *(count(measured) for measured in (usual, accurate)
                      for count in (our_cycles, their_iterations)))
    return text


def main(results, docs):
    verified = json.loads((results / "verify.json").read_text())
    (docs / "verification").mkdir(exist_ok=True)
    (docs / "verification" / "errors.md").write_text(
        "# All errors of the verification\n\nSee [verification](../verification.md).\n\n"
        + everything(verified))
    shutil.copy(results / "convergence.svg", docs / "verification")
    tables = {"meshes": by_mesh(verified), "problems": by_problem(verified),
              "orders": (results / "convergence.md").read_text(),
              "peers": peers(results)}
    page = docs / "verification.md"
    page.write_text(replace_tables(page, tables)[1])


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
