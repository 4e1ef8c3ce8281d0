#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two programs at once with the same scratch folder, the same output or the same checkpoint: each has
the right result, or is refused."""

import json
import os
import shutil
import subprocess

from program import SANITIZED, SMG, run, write_torus

ROUNDS = 3 if SANITIZED else 20
SIZES = ((40, 30), (36, 32))


def read(name):
    with open(name, "rb") as file:
        return file.read()


def together(*commands):
    """The exit codes and errors of programs that begin at once; an error is one line."""
    programs = [subprocess.Popen([SMG, *command, "--no-sync", "--quiet"], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True) for command in commands]
    ends = []
    for program in programs:
        _, error = program.communicate(timeout=600)
        assert program.returncode == 0 or program.returncode == 1 and error.count("\n") == 1, error
        ends.append((program.returncode, error))
    return ends


def solve(k, out, *options):
    return ("solve", "torus%d.vsm" % k, out, "--problem", "problem.json", "--core-nodes", "100",
            "--threads", "1", *options)


def convert(k, out, *options):
    return ("convert", "torus%d.obj" % k, out, *options)


def prepare():
    for folder in ("scratch", "out", "checkpoint"):
        shutil.rmtree(folder, ignore_errors=True)
    os.mkdir("scratch")
    os.mkdir("out")
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"halfspace": [1, 0, 0, 2.5], "value": 1},
                                 {"halfspace": [-1, 0, 0, 2.5], "value": 0}]}, file)
    expected = {}
    for k, size in enumerate(SIZES):
        write_torus("torus%d.obj" % k, *size)
        run("convert", "torus%d.obj" % k, "torus%d.vsm" % k, "--quiet")
        run(*solve(k, "whole%d.vsm" % k), "--quiet")
        expected[k] = (read("torus%d.vsm" % k), read("whole%d.vsm" % k))
    return expected


def test_scratch(expected):
    """Both are right, and nothing remains."""
    scratch = ("--scratch", "scratch")
    ends = together(solve(0, "out/0.vsm", *scratch), convert(1, "out/1.vsm", *scratch))
    assert ends == [(0, ""), (0, "")], ends
    assert read("out/0.vsm") == expected[0][1] and read("out/1.vsm") == expected[1][0]
    assert not os.listdir("scratch"), os.listdir("scratch")


def test_output(expected):
    """The result is the whole one of either program."""
    for command, kind in ((convert, 0), (solve, 1)):
        ends = together(command(0, "out/same.vsm"), command(1, "out/same.vsm"))
        assert ends == [(0, ""), (0, "")], ends
        assert read("out/same.vsm") in (expected[0][kind], expected[1][kind])


def test_checkpoint(expected):
    """One is refused while the other one runs; a later one, with another mesh, too."""
    kept = ("--checkpoint", "checkpoint")
    for second in (0, 1):
        ends = together(solve(0, "out/0.vsm", *kept), solve(second, "out/1.vsm", *kept))
        assert (0, "") in ends, ends
        for k, (mesh, (code, error)) in enumerate(zip((0, second), ends)):
            if code == 0:
                assert read("out/%d.vsm" % k) == expected[mesh][1]
            else:
                assert any(why in error for why in (
                    "another program is using this checkpoint",
                    "is the checkpoint of a computation with another mesh",
                    "is the checkpoint of a computation on another mesh file")), error
        assert not os.path.exists("checkpoint")


WHOLE = prepare()
for test in (test_scratch, test_output, test_checkpoint):
    for _ in range(ROUNDS):
        test(WHOLE)
        for left in ("out/0.vsm", "out/1.vsm", "out/same.vsm"):
            if os.path.exists(left):
                os.remove(left)
        assert not os.listdir("out"), os.listdir("out")
    print("passed", test.__name__)
