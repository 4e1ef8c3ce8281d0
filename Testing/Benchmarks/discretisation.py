#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""discretisation.py SMG MESH.vsm... : V-cycles to the discretisation error, and to fixed tolerances.

Solves -div grad u = f with 1 in the highest twentieth of the height (the last coordinate), 0 in the lowest one, and a source of
1e-6, with `SMG solve --tolerance auto`, 1e-6 and 1e-10. Prints a table: V-cycles, and the estimated algebraic and
discretisation errors in percent of the energy norm.
"""
import json
import os
import subprocess
import sys
import tempfile

HELD = 0.05  # of the height, at either end
SOURCE = 1e-6

TABLE = """| mesh | vertices | V-cycles, auto | V-cycles to 1e-6, 1e-10 | algebraic error | discretisation error |
|---|---|---|---|---|---|"""


def ends(bounds):
    low, high = bounds[4:]
    margin = HELD * (high - low)
    return {"source": SOURCE, "dirichlet": [{"halfspace": [0, 0, 1, high - margin], "value": 1},
                                            {"halfspace": [0, 0, -1, -(low + margin)], "value": 0}]}


def main(smg, *meshes):
    print(TABLE)
    with tempfile.TemporaryDirectory() as folder:
        out, problem, numbers = (os.path.join(folder, name) for name in ("out.vsm", "ends.json", "report.json"))

        def report(command, *arguments):
            subprocess.run([smg, command, *arguments, "--quiet", "--report", numbers], check=True)
            with open(numbers, encoding="utf-8") as file:
                return json.load(file)

        for mesh in meshes:
            with open(problem, "w", encoding="utf-8") as file:
                json.dump(ends(report("info", mesh)["bounds"]), file)
            auto, six, ten = (report("solve", mesh, out, "--problem", problem, "--tolerance", tolerance)
                              for tolerance in ("auto", "1e-6", "1e-10"))
            norm = auto["errors"]["energy_norm"]
            print("| %s | %d | %d | %d, %d | %.2g %% | %.2g %% |" % (
                os.path.basename(mesh), auto["vertices"], auto["cycles"], six["cycles"], ten["cycles"],
                100 * auto["errors"]["algebraic"] / norm, 100 * auto["errors"]["discretisation"] / norm), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
