#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The library for processors with AVX2 is taken where there is AVX2, and gives the same bits."""

import glob
import json
import os
import subprocess
import sys

from program import SMG, write_medit, write_torus
from tetrahedra import tetrahedra

# Tells the loader and the C library that the processor has no AVX2.
PLAIN = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2"}
FAST = {name: value for name, value in os.environ.items() if name != "GLIBC_TUNABLES"}
ENDS = {"weights": "cotangent", "columns": 3, "dirichlet": [
    {"halfspace": [0, 0, 1, 0.8], "value": "position"},
    {"halfspace": [0, 0, -1, 0.8], "value": "position"}]}


def libraries(environment):
    """What the loader says of the libraries that it takes."""
    done = subprocess.run([SMG, "--version"], env={**environment, "LD_DEBUG": "libs"},
                          capture_output=True, text=True, check=True, timeout=120)
    return [line for line in done.stderr.splitlines() if "calling init" in line]


def is_there():
    """Whether the processor has AVX2 and the library is built."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = next((line.split() for line in file if line.startswith("flags")), [])
    top = os.path.dirname(os.path.dirname(SMG))
    return {"avx2", "bmi2", "fma", "movbe"} <= set(flags) and glob.glob(
        top + "/lib*/**/glibc-hwcaps/x86-64-v3/libsmgSolver.so.*", recursive=True)


def solve(mesh, options, environment):
    subprocess.run([SMG, "convert", mesh, "mesh.vsm", "--quiet"], env=environment, check=True)
    subprocess.run([SMG, "solve", "mesh.vsm", "out.vsm", "--problem", "ends.json", "--quiet",
                    *options], env=environment, check=True, timeout=120)
    with open("out.vsm", "rb") as file:
        return file.read()


if not is_there():
    sys.exit(77)
assert any("glibc-hwcaps/x86-64-v3/libsmgSolver" in line for line in libraries(FAST))
assert not any("glibc-hwcaps/x86-64-v3/libsmgSolver" in line for line in libraries(PLAIN))
write_torus("torus.obj", 120, 60)
corners, solid = tetrahedra(14)
write_medit("cube.mesh", [tuple(x / 6.5 - 1 for x in corner) for corner in corners], solid)
with open("ends.json", "w", encoding="utf-8") as ends:
    json.dump(ENDS, ends)
for name in ("torus.obj", "cube.mesh"):
    for choice in ([], ["--in-core"], ["--acceleration", "none"]):
        assert solve(name, choice, FAST) == solve(name, choice, PLAIN), (name, choice)
