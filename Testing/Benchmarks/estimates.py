#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""estimates.py SMG MESH.vsm... : what each command needs, and what --dry-run says of it before.

Prints a table: accounted memory, scratch files, passes and processor time, each as truth / estimate.
The constants of Solver/Jobs/Estimate/Costs.cpp and Solver/Multigrid/Engine/MemoryPlan.cpp were fitted to this table.
"""
import json
import os
import subprocess
import sys
import tempfile

PLACES = '{"nearest": [[-1e9, 0, 0]]}', '{"nearest": [[1e9, 0, 0]]}'
PROBLEM = '{"dirichlet": [{"nearest": [[-1e9, 0, 0]], "value": %s}, {"nearest": [[1e9, 0, 0]], "value": %s}]%s}'
HANDLES = ('{"handles": [{"region": {"nearest": [[-1e9, 0, 0]]}, "fixed": true}, '
           '{"region": {"nearest": [[1e9, 0, 0]]}, "translate": [0, 0, 0.001]}]}')


def cases(folder, is_surface):
    """The commands: name and arguments."""
    def file(name, text):
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    one = file("one.json", PROBLEM % ("0", "1", ""))
    three = file("three.json", PROBLEM % ("[0, 0, 0]", "[1, 2, 3]", ', "columns": 3'))
    handles = file("handles.json", HANDLES)
    digits = ["--tolerance", "1e-6"]
    yield "solve", ["--problem", one, *digits]
    yield "solve 3", ["--problem", three, *digits]
    yield "solve 1e-10", ["--problem", one, "--tolerance", "1e-10"]
    yield "solve plain", ["--problem", one, *digits, "--acceleration", "none"]
    yield "deform", ["--handles", handles, "--cycles", "3"]
    yield "deform 1e-6", ["--handles", handles]
    if is_surface:
        yield "smooth", digits
        yield "smooth edges", ["--keep-edges", "30", "--steps", "2", *digits]
    else:
        yield "distance wall", ["--wall"]
    yield "distance", ["--from", PLACES[0]]


def report(smg, command, mesh, out, arguments, *more):
    """The report of a command."""
    name = out + ".json"
    subprocess.run([smg, command.split()[0], mesh, out, *arguments, "--quiet", "--threads", "1", "--report", name, *more],
                   check=True, stdout=subprocess.DEVNULL)
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def main(smg, *meshes):
    print("| mesh | command | MiB of memory | MiB of scratch | passes | CPU s | MiB of result |")
    print("|---|---|---|---|---|---|---|")
    for mesh in meshes:
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out.vsm")
            report_of_mesh = subprocess.run([smg, "info", mesh], check=True, capture_output=True, text=True).stdout
            for name, arguments in cases(folder, "triangle" in report_of_mesh):
                said = report(smg, name, mesh, out, arguments, "--dry-run")
                done = report(smg, name, mesh, out, arguments)
                mib = 2 ** 20
                pairs = ((done["pool_bytes_peak"] / mib, said["memory_bytes"] / mib),
                         (done["scratch_bytes_peak"] / mib, said["scratch_bytes"] / mib),
                         (done["passes"], said["passes"]), (done["cpu_seconds"], said["cpu_seconds"]),
                         (os.path.getsize(out) / mib, said["output_bytes"] / mib))
                print("| %s | %s | %s |" % (os.path.basename(mesh), name,
                                            " | ".join("%.3g / %.3g" % pair for pair in pairs)), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
