#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every failure of the system, one after another: call N of a command fails for N = 1, 2, ... until
the command succeeds without a failure. Each run must end with one error of one line, or with the
bit-equal result; nothing else remains, and a file that was there before is whole. A command with a
checkpoint must have the bit-equal result when it is run again after the error.

usage: smg_faults.py [all | COMMAND | CALL | HOW]
  without an argument: one conversion and one solve, with errors and with flipped bits; all: every
  command and kind of failure, which takes hours; otherwise those of a command, of a call (files,
  memory, new) or of a kind ("once 28")
"""

import errno
import multiprocessing
import os
import select
import shutil
import signal
import subprocess
import sys
import time

from program import SANITIZED, SMG, write_medit, write_torus
from tetrahedra import tetrahedra
from torus import torus

OLD = b"a file that was there before\n"
SECONDS = 60  # of a run that hangs; a usual one takes a fiftieth of a second

FILES = ["%s %d" % (often, getattr(errno, name)) for often in ("once", "forever")
         for name in ("ENOSPC", "EIO", "EMFILE")]
FILES += ["once %d" % errno.EINTR]
FILES += ["%s %s" % (often, what) for what in ("short", "zero", "flip") for often in ("once", "forever")]
NONE = "files 0 once kill"
MEMORY = ["once %d" % errno.ENOMEM, "forever %d" % errno.ENOMEM]


def commands():
    """The commands: name, arguments with OUT for the result, suffix of the result."""
    found = {}
    for order in ("bfs", "axis", "keep", "spectral"):
        found["convert-" + order] = ("convert", "torus.obj", "OUT", "--order", order), ".vsm"
    found["convert-solid"] = ("convert", "cube.mesh", "OUT"), ".vsm"
    for suffix in (".ply", ".vtp", ".sma", ".smb", ".vtkhdf"):
        found["write" + suffix] = ("convert", "torus.vsm", "OUT"), suffix
    for suffix in (".vtu", ".svb"):
        found["write" + suffix] = ("convert", "cube.vsm", "OUT"), suffix
    for suffix in (".ply", ".off", ".stl", ".vtp", ".smb"):
        found["read" + suffix] = ("convert", "torus" + suffix, "OUT"), ".vsm"
    found["read.vtu"] = ("convert", "cube.vtu", "OUT"), ".vsm"
    for suffix in (".ply", ".obj", ".off", ".stl", ".vtk", ".vtp", ".msh"):
        found["restore" + suffix] = ("convert", "torus.vsm", "OUT", "--restore-order"), suffix
    # Levels of so few nodes would otherwise stay in memory.
    streamed = ("--core-nodes", "300", "--block-nodes", "600", "--threads", "1")
    problem = ("--problem", "problem.json", *streamed)
    deform = ("deform", "torus.vsm", "OUT", "--handles", "handles.json", *streamed)
    found["solve"] = ("solve", "torus.vsm", "OUT", *problem), ".vsm"
    found["solve-solid"] = ("solve", "cube.vsm", "OUT", *problem), ".vsm"
    found["solve-obj"] = ("solve", "torus.obj", "OUT", *problem), ".ply"
    found["deform"] = deform, ".vsm"
    found["smooth"] = ("smooth", "torus.vsm", "OUT", "--size", "2%"), ".vsm"
    found["distance"] = ("distance", "torus.vsm", "OUT", "--from", '{"vertices": [0]}'), ".vsm"
    found["blend"] = ("blend", "scan.vsm", "OUT", "--patch", "scan", "--columns", "light"), ".vsm"
    found["preview"] = ("preview", "torus.vsm", "OUT", "--points", "500"), ".vtp"
    checkpoint = ("--checkpoint", "checkpoint")
    found["checkpoint-convert"] = (*found["convert-bfs"][0], *checkpoint), ".vsm"
    found["checkpoint-solve"] = ("solve", "torus.obj", "OUT", *problem, *checkpoint), ".vsm"
    found["checkpoint-deform"] = (*deform, *checkpoint), ".vsm"
    for name in ("convert", "solve", "deform"):
        found["continue-" + name] = found["checkpoint-" + name]
    # The lessons in C++ with VTK: reader, filter and writer; previews.
    for name in ("smoothing", "deformation", "distances", "blending"):
        found["vtk_" + name] = (vtk_program("vtk_" + name), "bunny.vsm", "OUT"), ".vsm"
    for name in ("reader", "filter"):
        found["vtk_preview-" + name] = (vtk_program("vtk_preview"), name, "bunny.vsm", "OUT"), ".obj"
    return {name: command for name, command in found.items()
            if not os.path.isabs(command[0][0]) or os.path.exists(command[0][0])}


def vtk_program(name):
    return os.path.join(os.path.dirname(SMG), name)


class Program:
    """smg, or another program, which is started once and runs once for each fault."""

    def __init__(self, arguments, scratch="scratch", quiet=("--quiet",)):
        if not os.path.isabs(arguments[0]):
            arguments = [SMG, *arguments, *quiet, "--scratch", scratch]
        self.arguments = arguments
        self.process = subprocess.Popen(arguments, env=environment(arguments, scratch), stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, start_new_session=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()

    def run(self, fault):
        """Returns the exit code, the output, and the calls counted."""
        if os.path.exists("count"):
            os.remove("count")
        self.process.stdin.write(fault.encode() + b"\n")
        self.process.stdin.flush()
        if not select.select([self.process.stdout], [], [], SECONDS)[0]:
            os.killpg(self.process.pid, signal.SIGKILL)
            raise subprocess.TimeoutExpired(self.arguments, SECONDS)
        code = int(self.process.stdout.readline())
        said = read("said").decode()
        return code, said, int(read("count")) if os.path.exists("count") else 0


def environment(arguments, scratch):
    # Nobody can notice flipped bits of inputs that have no checksums.
    spared = [name for name in arguments if os.path.isfile(name) and not name.endswith(".vsm")]
    # The library that fails is loaded before that of AddressSanitizer.
    return dict(os.environ, ASAN_OPTIONS="verify_asan_link_order=0",
                LD_PRELOAD=os.environ["SMG_FAULT_LIBRARY"], SMG_FAULT_SERVER="said",
                SMG_FAULT_COUNT="count", SMG_FAULT_SPARED=":".join(spared),
                TMPDIR=os.path.abspath(scratch))


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
        lines = [line for line in said.splitlines() if " continues after " not in line]
        is_told = ("ERR|" in said if case.startswith("vtk")
                   else len(lines) == 1 and lines[0].startswith("smg: "))
        assert code == 1 and is_told, (case, code, said)
        assert found in (OLD, wanted), (case, "a partial result", said)


def prepare_checkpoint(name):
    """The state before a run: no checkpoint, or one that a kill has left."""
    shutil.rmtree("checkpoint", ignore_errors=True)
    if name.startswith("continue"):
        shutil.copytree("killed", "checkpoint")


def walk(name, arguments, suffix, call, how, step=1):
    """Lets call N fail for N = 1, 1 + step, ...; returns the number of runs and of errors."""
    out = os.path.join("out", "result" + suffix)
    for folder in ("out", "scratch", "killed", "checkpoint"):
        shutil.rmtree(folder, ignore_errors=True)
    os.mkdir("out")
    os.mkdir("scratch")
    with Program([out if argument == "OUT" else argument for argument in arguments]) as program:
        code, said, calls = program.run(NONE)
        assert code == 0, (name, said)
        wanted = read(out)
        if name.startswith("continue"):
            program.run("files %d once kill" % (calls * 3 // 5))
            os.rename("checkpoint", "killed")
            for folder in ("out", "scratch"):
                shutil.rmtree(folder)
                os.mkdir(folder)
        runs, errors, number = 0, 0, 1
        while True:
            prepare_checkpoint(name)
            with open(out, "wb") as file:
                file.write(OLD)
            case = "%s: %s %d %s" % (name, call, number, how)
            code, said, counted = program.run("%s %d %s" % (call, number, how))
            check(case, code, said, out, wanted)
            if counted < number:
                assert code == 0, (case, said)
                return runs, errors
            runs, errors, number = runs + 1, errors + (code != 0), number + step
            if "--checkpoint" in arguments and code != 0:
                code, said, _ = program.run(NONE)
                assert code == 0, (case, "and again", said)
                check(case + ", and again", code, said, out, wanted)


def write_bunny(name, torus):
    """A torus as large as the bunny of the lessons, where that has its head and its base."""
    with open(torus, encoding="utf-8") as file, open(name, "w", encoding="utf-8") as out:
        for line in file:
            kind, *numbers = line.split()
            if kind == "v":
                x, y, z = map(float, numbers)
                numbers = (0.035 * x - 0.02, 0.035 * y + 0.1, 0.07 * z + 0.01)
            out.write(" ".join((kind, *map(str, numbers))) + "\n")


def write_scan(name):
    """A torus with the values of two scanners."""
    points, quadrangles = torus(50, 40)
    with open(name, "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        file.writelines("property float %s\n" % axis for axis in "xyz")
        file.write("property float light\nproperty int scan\nelement face %d\n" % len(quadrangles))
        file.write("property list uchar int vertex_indices\nend_header\n")
        file.writelines("%.9g %.9g %.9g %g %d\n" % (*point, point[1] + (point[0] > 0), point[0] > 0)
                        for point in points)
        file.writelines("4 %d %d %d %d\n" % quadrangle for quadrangle in quadrangles)


def convert(mesh, out, *options):
    subprocess.run([SMG, "convert", mesh, out, "--quiet", *options], check=True)


def write_inputs():
    write_torus("torus.obj", 50, 40)
    write_medit("cube.mesh", *tetrahedra(11))
    write_bunny("bunny.obj", "torus.obj")
    write_scan("scan.ply")
    with open("problem.json", "w", encoding="utf-8") as file:
        file.write('{"dirichlet": [{"vertices": [0], "value": 0}, {"vertices": [999], "value": 1}]}')
    with open("handles.json", "w", encoding="utf-8") as file:
        file.write('{"handles": [{"region": {"vertices": [0, 1, 2]}, "fixed": true}, {"region": '
                   '{"vertices": [1000, 1001, 1002]}, "translate": [0, 0, 0.5]}]}')
    for mesh in ("torus.obj", "cube.mesh", "bunny.obj", "scan.ply"):
        convert(mesh, mesh.split(".", maxsplit=1)[0] + ".vsm")
    convert("torus.obj", "torus.smb")
    for out in ("torus.ply", "torus.off", "torus.stl", "torus.vtp", "cube.vtu"):
        convert(out.split(".", maxsplit=1)[0] + ".vsm", out, "--restore-order")


def begin_worker():
    """Each process has its own folder."""
    folder = "worker-%d" % os.getpid()
    os.mkdir(folder)
    os.chdir(folder)
    write_inputs()


def walk_case(case):
    """Returns a line about the walk, and whether it went as it must."""
    name, call, how = case
    begin = time.monotonic()
    arguments, suffix = commands()[name]
    try:
        runs, errors = walk(name, arguments, suffix, call, how, 29 if SANITIZED else 1)
    except (AssertionError, subprocess.TimeoutExpired) as error:
        return False, "FAILED: %s" % error
    return True, "%-18s %-7s %-12s %5d calls failed, %5d errors, %5.1f s" % (
        name, call, how, runs, errors, time.monotonic() - begin)


def cases(which):
    """(command, call, failure): those of each build, or all."""
    usual = [(name, "files", how) for name in ("convert-bfs", "solve")
             for how in ("once %d" % errno.EIO, "once flip")]
    every = [(name, call, how) for name in commands()
             for call, ways in (("files", FILES), ("memory", MEMORY), ("new", MEMORY[:1]))
             # The calculator of VTK in this lesson ends the program.
             if (name, call) != ("vtk_blending", "new") for how in ways]
    if which == "all":
        return every
    return [case for case in every if which in case] or usual


def main(chosen):
    for name in os.listdir("."):
        if name.startswith("worker-"):
            shutil.rmtree(name)
    processes = min(len(chosen), os.cpu_count())
    with multiprocessing.Pool(processes, begin_worker) as pool:
        right = True
        for is_right, line in pool.imap_unordered(walk_case, chosen):
            print(line, flush=True)
            right = right and is_right
    sys.exit(0 if right else 1)


if __name__ == "__main__":
    main(cases(" ".join(sys.argv[1:])))
