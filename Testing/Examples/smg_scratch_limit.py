#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""--scratch-limit of each command, with the conversion of IN and the writing of OUT: what the report states as the
need passes with the same result, less is an error with both figures and without a result."""

import os
import re
import shutil

from program import load, run
from torus import torus

MIB = 1 << 20
PLACE = '{"vertices": [0]}'
COMMANDS = {
    "convert": [],
    "solve": ["--problem", "problem.json"],
    "deform": ["--handles", "handles.json", "--cycles", "2"],
    "smooth": [],
    "distance": ["--from", PLACE],
    "blend": ["--patch", "scan", "--columns", "shade"],
}


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def write_inputs():
    """A torus with a column and patches."""
    points, quadrangles = torus(200, 120)
    with open("torus.ply", "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        file.writelines("property double %s\n" % name for name in ("x", "y", "z", "shade"))
        file.write("property int scan\nelement face %d\n" % len(quadrangles))
        file.write("property list uchar int vertex_indices\nend_header\n")
        file.writelines("%r %r %r %r %d\n" % (*p, p[2], p[0] > 0) for p in points)
        file.writelines("4 %d %d %d %d\n" % face for face in quadrangles)
    write("problem.json", '{"dirichlet": [{"vertices": [0], "value": 0}, {"vertices": [999], "value": 1}]}')
    write("handles.json", '{"handles": [{"region": {"vertices": [0, 1, 2]}, "fixed": true}, {"region": '
          '{"vertices": [1000, 1001, 1002]}, "translate": [0, 0, 0.5]}]}')


def read(name):
    with open(name, "rb") as file:
        return file.read()


def check(command, source, out):
    common = [command, source, out, *COMMANDS[command], "--scratch", "scratch", "--quiet"]
    run(*common, "--report", "report.json")
    wanted, need = read(out), load("report.json")["scratch_bytes_peak"]
    os.remove(out)
    enough = -(-need // MIB)
    assert enough > 1, (command, need)
    run(*common, "--scratch-limit", enough, "--report", "report.json")
    assert read(out) == wanted, command
    assert load("report.json")["scratch_bytes_peak"] == need, command
    for limit in sorted({1, enough // 2, enough - 1}):
        write(out, "old")
        said = run(*common, "--scratch-limit", limit, code=1).stderr
        figures = re.search(r"take at least \d+ MiB \((\d+) bytes\) but their limit is (\d+) MiB", said)
        assert figures and int(figures[1]) > limit * MIB and int(figures[2]) == limit, said
        assert os.path.abspath("scratch") in said and "--scratch-limit" in said, said
        assert read(out) == b"old" and os.listdir("scratch") == [], command


shutil.rmtree("scratch", ignore_errors=True)
os.mkdir("scratch")
write_inputs()
run("convert", "torus.ply", "torus.vsm", "--quiet")
for each in COMMANDS:
    check(each, "torus.ply", "o.vsm" if each == "convert" else "o.ply")
    if each != "convert":
        check(each, "torus.vsm", "o.vsm")
run("convert", "torus.ply", "o.vsm", "--scratch-limit", 0, code=2)
