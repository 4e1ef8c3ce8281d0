#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every failure of the system, one after another: call N of a command fails for N = 1, 2, ... until
the command succeeds without a failure. Each run must end with one error of one line, or with the
bit-equal result; nothing else remains, and a file that was there before is whole.

usage: smg_faults.py [all | COMMAND | CALL | HOW]
  without an argument: one conversion and one solve, which fail once; all: every command and kind of
  failure, which takes an hour; otherwise those of a command, of a call (files, memory, new) or of a
  kind ("once 28")
"""

import errno
import os
import shutil
import signal
import subprocess
import sys
import time

from program import SANITIZED, SMG, write_medit, write_torus
from tetrahedra import tetrahedra

OLD = b"a file that was there before\n"
SECONDS = 60  # of a run that hangs; a usual one takes a fiftieth of a second

ALL = ["%s %d" % (often, getattr(errno, name)) for often in ("once", "forever")
       for name in ("ENOSPC", "EIO", "EMFILE")]
ALL += ["once %d" % errno.EINTR, "once short", "forever short", "once zero", "forever zero"]


def commands():
    """The commands: name, arguments with OUT for the result, suffix of the result."""
    found = {}
    for order in ("bfs", "axis", "keep", "spectral"):
        found["convert-" + order] = ("convert", "torus.obj", "OUT", "--order", order), ".vsm"
    for suffix in (".ply", ".vtp", ".sma", ".smb", ".vtkhdf"):
        found["write" + suffix] = ("convert", "torus.vsm", "OUT"), suffix
    for suffix in (".ply", ".off", ".stl", ".vtp", ".smb"):
        found["read" + suffix] = ("convert", "torus" + suffix, "OUT"), ".vsm"
    for suffix in (".vtu", ".svb"):
        found["write-solid" + suffix] = ("convert", "cube.vsm", "OUT"), suffix
    found["read.vtu"] = ("convert", "cube.vtu", "OUT"), ".vsm"
    found["convert-solid"] = ("convert", "cube.mesh", "OUT"), ".vsm"
    for suffix in (".ply", ".obj", ".off", ".stl", ".vtk", ".vtp", ".msh"):
        found["restore" + suffix] = ("convert", "torus.vsm", "OUT", "--restore-order"), suffix
    # Levels of so few nodes would otherwise stay in memory.
    streamed = ("--core-nodes", "300", "--block-nodes", "600", "--threads", "1")
    problem = ("--problem", "problem.json", *streamed)
    found["solve"] = ("solve", "torus.vsm", "OUT", *problem), ".vsm"
    found["solve-solid"] = ("solve", "cube.vsm", "OUT", *problem), ".vsm"
    found["solve-obj"] = ("solve", "torus.obj", "OUT", *problem), ".ply"
    found["deform"] = ("deform", "torus.vsm", "OUT", "--handles", "handles.json", *streamed), ".vsm"
    found["smooth"] = ("smooth", "torus.vsm", "OUT", "--size", "2%"), ".vsm"
    found["distance"] = ("distance", "torus.vsm", "OUT", "--from", '{"vertices": [0]}'), ".vsm"
    found["preview"] = ("preview", "torus.vsm", "OUT", "--points", "500"), ".vtp"
    # The lessons in C++ with VTK: reader, filter and writer.
    for lesson in ("smoothing", "deformation"):
        program = os.path.join(os.path.dirname(SMG), "vtk_" + lesson)
        if os.path.exists(program):
            found["vtk_" + lesson] = (program, "bunny.vsm", "OUT"), ".vsm"
    return found


def run(arguments, fault, out):
    """Runs smg, or another program, with a fault; returns the exit code, its error output and the
    calls counted."""
    # The library that fails is loaded before that of AddressSanitizer.
    environment = dict(os.environ, ASAN_OPTIONS="verify_asan_link_order=0",
                       LD_PRELOAD=os.environ["SMG_FAULT_LIBRARY"], SMG_FAULT=fault,
                       SMG_FAULT_COUNT="count", TMPDIR=os.path.abspath("scratch"))
    arguments = [out if argument == "OUT" else argument for argument in arguments]
    if os.path.exists("count"):
        os.remove("count")
    if not os.path.isabs(arguments[0]):
        arguments = [SMG, *arguments, "--quiet", "--scratch", "scratch"]
    done = subprocess.run(arguments, env=environment, capture_output=True, text=True, timeout=SECONDS)
    with open("count", encoding="ascii") as file:
        return done.returncode, done.stdout + done.stderr, int(file.read())


def read(name):
    with open(name, "rb") as file:
        return file.read()


def check(case, code, said, out, wanted):
    """The state after a run."""
    assert sorted(os.listdir("scratch")) == [], (case, os.listdir("scratch"), said)
    assert os.listdir("out") == [os.path.basename(out)], (case, os.listdir("out"), said)
    found = read(out)
    if code == 0:
        assert found == wanted, (case, "the result is another one")
    else:
        # In a pipeline, the filters after the one that failed say so, too.
        is_told = ("ERR|" in said if case.startswith("vtk")
                   else said.startswith("smg: ") and said.count("\n") == 1)
        assert code == 1 and is_told, (case, code, said)
        assert found in (OLD, wanted), (case, "a partial result", said)


def walk(name, arguments, suffix, call, how, step=1):
    """Lets call N fail for N = 1, 1 + step, ...; returns the number of runs and of errors."""
    out = os.path.join("out", "result" + suffix)
    shutil.rmtree("out", ignore_errors=True)
    os.mkdir("out")
    code, said, calls = run(arguments, "%s 0 %s" % (call, how), out)
    assert code == 0, (name, said)
    wanted = read(out)
    runs, errors, number = 0, 0, 1
    while True:
        with open(out, "wb") as file:
            file.write(OLD)
        case = "%s: %s %d %s" % (name, call, number, how)
        code, said, counted = run(arguments, "%s %d %s" % (call, number, how), out)
        check(case, code, said, out, wanted)
        if counted < number:
            assert code == 0, (case, said)
            return runs, errors
        runs, errors, number = runs + 1, errors + (code != 0), number + step


def write_bunny(name, torus):
    """A torus as large as the bunny of the lessons, where that has its head and its base."""
    with open(torus, encoding="utf-8") as file, open(name, "w", encoding="utf-8") as out:
        for line in file:
            kind, *numbers = line.split()
            if kind == "v":
                x, y, z = map(float, numbers)
                numbers = (0.035 * x - 0.02, 0.035 * y + 0.1, 0.07 * z + 0.01)
            out.write(" ".join((kind, *map(str, numbers))) + "\n")


def write_inputs():
    write_torus("torus.obj", 50, 40)
    write_medit("cube.mesh", *tetrahedra(11))
    write_bunny("bunny.obj", "torus.obj")
    with open("problem.json", "w", encoding="utf-8") as file:
        file.write('{"dirichlet": [{"vertices": [0], "value": 0}, {"vertices": [999], "value": 1}]}')
    with open("handles.json", "w", encoding="utf-8") as file:
        file.write('{"handles": [{"region": {"vertices": [0, 1, 2]}, "fixed": true}, {"region": '
                   '{"vertices": [1000, 1001, 1002]}, "translate": [0, 0, 0.5]}]}')
    for mesh, suffixes in (("torus", (".ply", ".off", ".stl", ".vtp")), ("cube", (".vtu",))):
        subprocess.run([SMG, "convert", "%s%s" % (mesh, ".obj" if mesh == "torus" else ".mesh"),
                        mesh + ".vsm", "--quiet"], check=True)
        for suffix in suffixes:
            subprocess.run([SMG, "convert", mesh + ".vsm", mesh + suffix, "--restore-order", "--quiet"],
                           check=True)
    for mesh in ("torus.smb", "bunny.vsm"):
        subprocess.run([SMG, "convert", mesh[:5] + ".obj", mesh, "--quiet"], check=True)


def main(chosen):
    shutil.rmtree("scratch", ignore_errors=True)
    os.mkdir("scratch")
    write_inputs()
    found = commands()
    for name, call, how in chosen:
        begin = time.monotonic()
        arguments, suffix = found[name]
        runs, errors = walk(name, arguments, suffix, call, how, 29 if SANITIZED else 1)
        print("%-16s %-7s %-12s %5d calls failed, %5d errors, %5.1f s" % (
            name, call, how, runs, errors, time.monotonic() - begin), flush=True)


def cases(which):
    """(command, call, failure): those of each build, or all."""
    usual = [("convert-bfs", "files", "once %d" % errno.EIO), ("solve", "files", "once %d" % errno.EIO)]
    memory = ["once %d" % errno.ENOMEM, "forever %d" % errno.ENOMEM]
    every = [(name, call, how) for name in commands()
             for call, ways in (("files", ALL), ("memory", memory), ("new", memory[:1])) for how in ways]
    if which == "all":
        return every
    return [case for case in every if which in case] or usual


if __name__ == "__main__":
    main(cases(" ".join(sys.argv[1:])))
