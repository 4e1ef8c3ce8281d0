#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The library for processors with AVX2 is loaded if there is AVX2, and gives the same bits."""

import json
import os
import subprocess
import sys

from program import SMG, write_medit, write_torus
from tetrahedra import tetrahedra

FOLDER = "glibc-hwcaps/x86-64-v3/"
ENDS = {"weights": "cotangent", "columns": 3, "dirichlet": [
    {"halfspace": [0, 0, 1, 0.8], "value": "position"},
    {"halfspace": [0, 0, -1, 0.8], "value": "position"}]}
HANDLES = {"handles": [
    {"region": {"halfspace": [0, 0, -1, 0.8]}, "fixed": True},
    {"region": {"halfspace": [0, 0, 1, 0.8]}, "translate": [0.1, 0.2, 0.7],
     "rotate": {"axis": [1, 2, 3], "degrees": 50, "center": [0, 0, 1]}, "scale": 1.3}]}


def library(environment):
    """The file of the solver's library that the loader chooses."""
    done = subprocess.run([SMG, "--version"], env={**environment, "LD_DEBUG": "libs"},
                          capture_output=True, text=True, check=True, timeout=1200)
    return next(line.split()[-1] for line in done.stderr.splitlines()
                if "calling init" in line and "libsmgSolver" in line)


def is_wanted():
    """Whether the processor has AVX2 and the library is to be built."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = next((line.split() for line in file if line.startswith("flags")), [])
    return {"avx2", "bmi2", "fma", "movbe"} <= set(flags) and os.environ["SMG_BUILDS_V3"] == "1"


def result(command, mesh, options, environment):
    """The bytes of the file that `smg command` makes of a mesh."""
    subprocess.run([SMG, "convert", mesh, "mesh.vsm", "--quiet"], env=environment, check=True)
    subprocess.run([SMG, command, "mesh.vsm", "out.vsm", "--quiet", *options], env=environment,
                   check=True, timeout=1200)
    with open("out.vsm", "rb") as file:
        return file.read()


if not is_wanted():
    sys.exit(77)
FAST = {name: value for name, value in os.environ.items()
        if name not in ("GLIBC_TUNABLES", "LD_PRELOAD")}
assert FOLDER in library(FAST), library(FAST)
# Loaded libraries are not searched again. The C library, whose sines depend on the processor,
# stays.
PLAIN = {**FAST, "LD_PRELOAD": library(FAST).replace(FOLDER, "")}
assert FOLDER not in library(PLAIN), library(PLAIN)
write_torus("torus.obj", 120, 60)
corners, solid = tetrahedra(14)
write_medit("cube.mesh", [tuple(x / 6.5 - 1 for x in corner) for corner in corners], solid)
with open("ends.json", "w", encoding="utf-8") as ends:
    json.dump(ENDS, ends)
with open("handles.json", "w", encoding="utf-8") as handles:
    json.dump(HANDLES, handles)
for name in ("torus.obj", "cube.mesh"):
    for run in (("solve", ["--problem", "ends.json"]),
                ("solve", ["--problem", "ends.json", "--in-core"]),
                ("solve", ["--problem", "ends.json", "--acceleration", "none"]),
                ("deform", ["--handles", "handles.json"])):
        assert result(run[0], name, run[1], FAST) == result(run[0], name, run[1], PLAIN), (name, run)
