#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""--dry-run of the commands that compute on a mesh: nothing is read or written, and the truth is near the estimate.

Memory and scratch files are within a factor of 2, passes within 1.5, on a surface and a solid."""

import math
import os

from program import load, run, write_medit, write_torus
from small_disk import SmallDisk, can_mount
from tetrahedra import tetrahedra

FIRST, LAST = '{"nearest": [[-9, 0, 0]]}', '{"nearest": [[9, 0, 0]]}'
MIB = 1 << 20


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def write_tasks():
    held = '"dirichlet": [{"halfspace": [-1, 0, 0, %s], "value": %s}, {"halfspace": [1, 0, 0, %s], "value": %s}]'
    for mesh, low, high in (("torus", 2.8, 2.8), ("cube", -0.02, 22.9)):
        write(mesh + "-one.json", "{%s}" % (held % (low, 0, high, 1)))
        write(mesh + "-three.json", '{"columns": 3, %s}' % (held % (low, [0, 0, 0], high, [1, 2, 3])))
        write(mesh + "-handles.json", '{"handles": [{"region": {"halfspace": [-1, 0, 0, %s]}, "fixed": true}, '
              '{"region": {"halfspace": [1, 0, 0, %s]}, "rotate": {"axis": [1, 0, 0], "degrees": 60, "center": [0, 0, 0]}}]}' % (low, high))


def commands(mesh):
    """Names of commands and their arguments."""
    yield "solve", ["--problem", mesh + "-one.json"]
    yield "solve", ["--problem", mesh + "-three.json", "--tolerance", "1e-9"]
    yield "deform", ["--handles", mesh + "-handles.json", "--cycles", "3"]
    yield "distance", ["--from", FIRST]
    if mesh == "torus":
        yield "smooth", []


def check(mesh, command, arguments, threads):
    common = [command, mesh + ".vsm", "o.vsm", *arguments, "--report", "report.json", "--threads", threads]
    shown = run(*common, "--dry-run").stdout
    said = load("report.json")
    assert not os.path.exists("o.vsm") and said["counted"]
    assert all(word in shown for word in ("vertices", "memory", "scratch", "output", "passes", "time")), shown
    run(*common, "--quiet")
    done = load("report.json")
    for what, truth, estimate, factor in (
            ("vertices", done["vertices"], said["vertices"], 1),
            ("memory", done["pool_bytes_peak"], said["memory_bytes"], 2),
            ("scratch", done["scratch_bytes_peak"], said["scratch_bytes"], 2),
            ("passes", done["passes"], said["passes"], 1.5),
            # Coordinates of a regular grid are compressed well, deformed ones are not.
            ("output", os.path.getsize("o.vsm"), said["output_bytes"], 2.5)):
        assert 1 / factor <= estimate / truth <= factor, (mesh, command, arguments, threads, what, truth, estimate)
    assert said["cpu_seconds"] > 0 and said["memory_limit"] == 1024 * MIB
    os.remove("o.vsm")


def test_room():
    """Disks that are too small are refused before anything is done, with both figures."""
    with SmallDisk("small", MIB) as disk:
        for arguments in (["solve", "torus.vsm", "o.vsm", "--problem", "torus-one.json", "--scratch", disk],
                          ["solve", "torus.vsm", disk + "/o.ply", "--problem", "torus-three.json"]):
            said = run(*arguments, code=1).stderr
            assert disk in said and "MiB, there is room for" in said, said
            assert os.listdir(disk) == [] and not os.path.exists("o.vsm")


def test_threads():
    """Tasks of several threads need memory between them, and longer steps for many more; --dry-run counts both."""
    def memory(threads):
        run("solve", "torus.vsm", "o.vsm", "--problem", "torus-three.json", "--dry-run", "--threads", threads, "--report",
            "dry.json")
        return load("dry.json")["memory_bytes"]

    assert memory("1") < memory("2") == memory("4") < memory("8") == memory("16")


def test_unconverted():
    """Of another file the conversion is counted, too, and the span is estimated."""
    run("solve", "torus.obj", "o.ply", "--problem", "torus-one.json", "--dry-run", "--report", "dry.json")
    said = load("dry.json")
    run("solve", "torus.obj", "o.ply", "--problem", "torus-one.json", "--quiet", "--report", "report.json")
    done = load("report.json")
    assert not said["counted"] and said["passes"] <= 1.5 * done["passes"]
    for truth, estimate in ((done["pool_bytes_peak"], said["memory_bytes"]),
                            (done["scratch_bytes_peak"], said["scratch_bytes"]),
                            (os.path.getsize("o.ply"), said["output_bytes"])):
        assert abs(math.log2(estimate / truth)) <= 2, (truth, estimate)


if os.path.exists("o.vsm"):  # of an earlier failed run
    os.remove("o.vsm")
write_torus("torus.obj", 300, 150)
write_medit("cube.mesh", *tetrahedra(24))
run("convert", "torus.obj", "torus.vsm", "--quiet")
run("convert", "cube.mesh", "cube.vsm", "--quiet")
write_tasks()
for each in ("torus", "cube"):
    for task in commands(each):
        for count in ("2", "8"):
            check(each, *task, count)
test_threads()
test_unconverted()
if can_mount():
    test_room()
