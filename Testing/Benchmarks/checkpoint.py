#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""checkpoint.py SMG MESH.vsm [PASS] : what a checkpoint costs, and what it saves.

Solves for three columns, the positions, held at both ends of the longest side of the mesh: without and with a
checkpoint, three times each in turn, and once killed when PASS passes (4) are complete and run again. Prints
processor and wall-clock seconds (the least of the three), the bytes of the checkpoint, and the share of the
whole solve that the second run takes; of a mesh so small that the solve ends before it is killed only the first
two. Files go to the current folder.
"""

import json
import os
import shutil
import struct
import subprocess
import sys
import time

FOLDER = "benchmark.checkpoint"


def write_problem(smg, mesh):
    subprocess.run([smg, "info", mesh, "--quiet", "--report", "info.json"], check=True)
    with open("info.json", encoding="utf-8") as file:
        ends = json.load(file)["bounds"]
    low, high = ends[0::2], ends[1::2]
    axis = max(range(3), key=lambda d: high[d] - low[d])
    margin = 0.02 * (high[axis] - low[axis])
    normal = [float(d == axis) for d in range(3)]
    places = (normal + [high[axis] - margin], [-n for n in normal] + [-low[axis] - margin])
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"columns": 3, "dirichlet": [
            {"halfspace": place, "value": "position"} for place in places]}, file)


def begin(smg, mesh, *options):
    return subprocess.Popen([smg, "solve", mesh, "solved.vsm", "--problem", "problem.json", "--quiet",
                             "--tolerance", "1e-8", "--report", "report.json", *options])


def measured(process):
    """Processor and wall-clock seconds to the end of a process."""
    start = time.monotonic()
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start


def steps():
    most = 0
    for slot in "01":
        try:
            with open(os.path.join(FOLDER, "state." + slot), "rb") as file:
                most = max(most, struct.unpack_from("=q", file.read(48), 16)[0])
        except OSError:
            pass
    return most


def size_of(folder):
    return sum(os.stat(os.path.join(folder, name)).st_blocks * 512 for name in os.listdir(folder))


def main(smg, mesh, passes=4):
    write_problem(smg, mesh)
    plain, kept = [], []
    for _ in range(3):
        plain.append(measured(begin(smg, mesh)))
        kept.append(measured(begin(smg, mesh, "--checkpoint", FOLDER)))
    cpu, wall = (min(times[k] for times in plain) for k in range(2))
    kept_cpu, kept_wall = (min(times[k] for times in kept) for k in range(2))
    rows = [("without a checkpoint", (cpu, wall)), ("with one", (kept_cpu, kept_wall))]
    shutil.rmtree(FOLDER, ignore_errors=True)
    process = begin(smg, mesh, "--checkpoint", FOLDER)
    while steps() < passes and process.poll() is None:
        time.sleep(0.01)
    process.kill()
    is_killed = process.wait() != 0
    if is_killed:
        reached, size = steps(), size_of(FOLDER)
        rows.append(("continued after pass %d" % reached, measured(begin(smg, mesh, "--checkpoint", FOLDER))))
    with open("report.json", encoding="utf-8") as file:
        report = json.load(file)
    print("| vertices | passes | | CPU s | wall s |\n|---|---|---|---|---|")
    for what, row in rows:
        print("| %d | %d | %s | %.2f | %.2f |" % (report["vertices"], report["passes"], what, *row))
    if is_killed:
        rest_cpu, rest_wall = rows[-1][1]
        print("\nA checkpoint takes %+.1f %% of CPU and %.0f MiB (%.0f bytes a vertex); the rest after pass %d "
              "takes %.0f %% of the CPU and %.0f %% of the time of a whole solve with a checkpoint." % (
                  100 * (kept_cpu / cpu - 1), size / 2**20, size / report["vertices"], reached,
                  100 * rest_cpu / kept_cpu, 100 * rest_wall / kept_wall))


main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
