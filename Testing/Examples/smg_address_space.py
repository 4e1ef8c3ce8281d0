#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg within an address space (ulimit -v) of its memory limit and a constant for the program, its
libraries and threads, on meshes that do not fit into that.

smg_address_space.py [NU NV MEMORY]: a torus of 1200 x 600 vertices in 24 MiB, or another one."""

import json
import os
import resource
import subprocess
import sys
import time

from large_torus import write_large_torus
from program import SANITIZED, SMG, load

if SANITIZED:
    print("sanitizers reserve the whole address space")
    sys.exit(77)

NU, NV, MEMORY = (int(number) for number in sys.argv[1:]) if sys.argv[1:] else (1200, 600, 24)
THREADS = 2
# MiB of address space besides the memory limit; windows, which large meshes need, are mapped twice.
CONVERTING, SOLVING = 32, 80 if MEMORY < 128 else 160
LEAST_MEMORY = 16
SMALL = not sys.argv[1:]


def peak_of(process):
    """The most address space of a process until it ended, MiB."""
    peak = 0
    while process.poll() is None:
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
            lines = [line for line in status if line.startswith("VmPeak")]
        peak = int(lines[0].split()[1]) / 1024 if lines else peak
        time.sleep(0.005)
    return peak


def run_within(mebibytes, *arguments):
    """Runs smg in so much address space; its exit code and error."""
    bytes_ = mebibytes << 20
    process = subprocess.Popen(
        [SMG, *map(str, arguments), "--threads", str(THREADS), "--quiet", "--no-sync"],
        stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (bytes_, bytes_)))
    peak = peak_of(process)
    error = process.communicate()[1]
    print(f"{arguments[0]}: exit code {process.returncode}, {peak:.0f} of {mebibytes} MiB {error.strip()}")
    return process.returncode, error


def passes(mebibytes, *arguments):
    code, error = run_within(mebibytes, *arguments)
    assert code == 0, (arguments, error)


def is_refused(mebibytes, *arguments):
    """The command must end with one error on memory: it does need more."""
    code, error = run_within(mebibytes, *arguments)
    assert code == 1 and error.count("\n") == 1 and "memory" in error, (arguments, code, error)
    assert not os.path.exists("refused.vsm")


def write_json(name, members):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(members, file)


write_large_torus("mesh.ply", NU, NV)
write_json("problem.json", {"columns": 3, "dirichlet": [
    {"halfspace": [1, 0, 0, 2.5], "value": "position"},
    {"halfspace": [-1, 0, 0, 2.5], "value": "position"}]})
write_json("handles.json", {"handles": [
    {"region": {"halfspace": [-1, 0, 0, 2.5]}, "fixed": True},
    {"region": {"halfspace": [1, 0, 0, 2.5]}, "translate": [0, 0, 1],
     "rotate": {"axis": [0, 0, 1], "degrees": 40, "center": [3, 0, 0]}}]})

# Positions and corners of 8 bytes each would not fit.
converting = (LEAST_MEMORY if SMALL else MEMORY) + CONVERTING
assert NU * NV * (3 + 2 * 3) * 8 > converting << 20
passes(converting, "convert", "mesh.ply", "mesh.vsm", "--memory", converting - CONVERTING)

solving = MEMORY + SOLVING
SOLVE = ("--problem", "problem.json", "--tolerance", 1e-3)
DEFORM = ("--handles", "handles.json")
for command, options in (("solve", SOLVE), ("deform", DEFORM)):
    passes(solving, command, "mesh.vsm", "result.vsm", *options, "--memory", MEMORY)
    os.remove("result.vsm")
passes(solving, "solve", "mesh.ply", "solved.ply", *SOLVE, "--memory", MEMORY, "--report", "report.json")
assert load("report.json")["converged"]
for command, options in (("solve", SOLVE), ("deform", DEFORM)):
    is_refused(solving, command, "mesh.vsm", "refused.vsm", *options, "--in-core", "--memory", 100000)
for name in ("mesh.ply", "mesh.vsm", "solved.ply"):
    os.remove(name)
print("passed")
