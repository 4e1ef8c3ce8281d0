#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""tables.py RESULTS DOCS : writes what was measured into the documentation.

RESULTS is the folder of run.sh: verify.json, convergence.md and .svg, and peers-MESH.json. DOCS/verification
is given the table of all errors and the plot; in DOCS/verification.md the tables between the lines
`<!-- NAME -->` and `<!-- end -->` are replaced.
"""
import json
import pathlib
import re
import shutil
import sys


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
    cycles = sorted(each["cycles"] for each in results)
    return f"{cycles[0]} - {cycles[-1]}"


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
                        each["cycles"])
    return text


def peers(files):
    text = head("mesh", "vertices", "streaming: V-cycles", "CPU us/vertex",
                "hypre BoomerAMG-PCG: iterations a column", "CPU us/vertex")
    for file in files:
        measured = json.loads(file.read_text())
        ours, theirs = (measured["results"][name] for name in ("smg", "hypre"))
        cost = [f"{1e6 * each['cpu_total'] / measured['vertices']:.1f}" for each in (ours, theirs)]
        iterations = f"{theirs['iterations'] / 3:.0f}"
        if theirs["relative_residual"] > 2 * measured["tolerance"]:
            iterations = f"none after {iterations}"
        text += row(measured["mesh"], measured["vertices"], ours["iterations"], cost[0],
                    iterations, cost[1])
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
              "peers": peers(sorted(results.glob("peers-*.json")))}
    page = docs / "verification.md"
    text = page.read_text()
    for name, table in tables.items():
        text = re.sub(f"(<!-- {name} -->\n).*?(<!-- end -->)",
                      lambda found: found[1] + table + found[2], text, flags=re.DOTALL)
    page.write_text(text)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
