# SPDX-License-Identifier: BSD-3-Clause
"""A pipeline in pvpython within an address space (ulimit -v) of its memory limit and a constant above
what the idle program has, on a mesh that does not fit into that; in one piece it does not pass.

address_space.py PVPYTHON PLUGIN [NU NV MEMORY BESIDE]: a torus of 1200 x 600 vertices in 24 MiB and 56
besides it, or another one. What is beside the limit grows with it, since windows are mapped three times."""

import os
import resource
import subprocess
import sys

import smg_testing as t
from paraview.simple import *

sys.path.insert(0, os.path.join(os.environ["SMG_SOURCE_DIR"], "Testing", "Examples"))
from large_torus import write_large_torus


def address_space(field):
    with open("/proc/self/status", encoding="utf-8") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(field)) / 1024


def solve_and_save(plugin, folder, memory, beside, pieces):
    """The pipeline in a process of its own, as its limit holds until its end."""
    LoadPlugin(plugin, ns=globals())
    t.StreamingPoisson = StreamingPoisson
    reader = OpenDataFile(os.path.join(folder, "mesh.vsm"))
    reader.MaximumPointsInMemory, reader.PreviewPoints = 10000, 10000
    poisson = t.make_poisson(t.make_problem(reader, "X", -2.5, 2.5))
    poisson.Solve, poisson.NumberOfThreads = "Full Mesh", 2
    poisson.MemoryLimit, poisson.NumberOfPieces = memory, pieces
    idle = address_space("VmSize")
    limit = int(idle + memory + beside) << 20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    poisson.UpdatePipeline()
    poisson.UpdatePropertyInformation()
    outcome = poisson.GetPropertyValue("Outcome")
    out = os.path.join(folder, "solved.vsm")
    if poisson.GetPropertyValue("Converged") == 1:
        SaveData(out, proxy=poisson)
    peak = address_space("VmPeak") - idle
    print(f"{pieces} pieces: {peak:.0f} of {memory + beside} MiB above {idle:.0f} MiB: {outcome}")
    return os.path.exists(out)


def run(*arguments):
    return subprocess.run([pvpython, __file__, pvpython, plugin, "solve", *map(str, arguments)],
                          check=False).returncode


pvpython, plugin, *size = sys.argv[1:]
if size[:1] == ["solve"]:
    sys.exit(0 if solve_and_save(plugin, size[1], *map(int, size[2:])) else 1)
nu, nv, memory, beside = (int(number) for number in size or (1200, 600, 24, 56))
folder = t.make_folder()
write_large_torus(os.path.join(folder, "mesh.ply"), nu, nv)
t.run_smg("convert", os.path.join(folder, "mesh.ply"), os.path.join(folder, "mesh.vsm"))
os.remove(os.path.join(folder, "mesh.ply"))
CHOSEN, WHOLE = 0, 1
assert run(folder, memory, beside, WHOLE) != 0
assert not os.path.exists(os.path.join(folder, "solved.vsm"))
assert run(folder, memory, beside, CHOSEN) == 0
print("passed")
