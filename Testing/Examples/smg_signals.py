#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every command ends within a second of SIGINT or SIGTERM, at any moment and on meshes of any kind, and leaves nothing.

With the word all: at many more moments, of larger meshes."""

import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

from large_torus import write_large_torus
from program import PROGRESS, SANITIZED, SMG, run, write_medit, write_ply
from tetrahedra import tetrahedra

ALL = sys.argv[1:] == ["all"]
MOMENTS = 12 if ALL else 1  # of each command and mesh
LONGEST = 20.0 if ALL else 1.0  # seconds until the last of these moments
LATEST = 10.0 if SANITIZED else 1.0  # seconds until the end
TRIES = 3  # of which the best counts, on a machine that does other things as well
FOLDERS = ("out", "scratch", "temporary")


def ring(count, height):
    return [(math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count), height) for k in range(count)]


def write_hub(name, count):
    """A disc of triangles around one vertex, within a ring of others, with a label of each side."""
    points = [(0, 0, 0), *ring(count, 0.1), *((2 * x, 2 * y, z) for x, y, z in ring(count, 0.3))]
    cells = []
    for k in range(count):
        a, b = 1 + k, 1 + (k + 1) % count
        cells += [(0, a, b), (a, a + count, b + count), (a, b + count, b)]
    write_labelled(name, points, cells)


def write_soup(name, count):
    """Triangles of a sphere, each with three vertices of its own."""
    numbers = random.Random(1)
    points = []
    for _ in range(count):
        z, turn = numbers.uniform(-1, 1), numbers.uniform(0, 2 * math.pi)
        x, y = math.sqrt(1 - z * z) * math.cos(turn), math.sqrt(1 - z * z) * math.sin(turn)
        points += [(x + numbers.uniform(0, 0.01), y, z + numbers.uniform(0, 0.01)) for _ in range(3)]
    write_labelled(name, points, [(k, k + 1, k + 2) for k in range(0, 3 * count, 3)])


def write_labelled(name, points, cells):
    write_ply(name, points, cells, {"patch": ("int", [int(x > 0) for x, _, _ in points]),
                                    "value": ("float", [math.sin(9 * y) + (x > 0) for x, y, _ in points])})


def write_meshes():
    """A torus, a cube of tetrahedra, a disc with a vertex of very many triangles, and triangles that share no vertex."""
    size = 1 if SANITIZED else 10 if ALL else 3
    write_large_torus("torus.ply", 150 * size, 80 * size)
    points, cells = tetrahedra(8 if SANITIZED else 40 if ALL else 24)
    write_medit("solid.mesh", points, cells)
    write_hub("hub.ply", 2000 if SANITIZED else 200000 if ALL else 50000)
    write_soup("soup.ply", 1000 if SANITIZED else 100000 if ALL else 30000)
    for name in ("torus.ply", "solid.mesh", "hub.ply", "soup.ply"):
        run("convert", name, name.split(".")[0] + ".vsm", "--quiet")
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"nearest": [[0, 0, 0]], "value": [1]}], "source": 1}, file)
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": {"nearest": [[9, 0, 0]]}, "translate": [0, 0, 1]},
                               {"region": {"nearest": [[-9, 0, 0]]}, "fixed": True}]}, file)


def commands():
    """Of every kind."""
    for mesh in ("torus", "solid", "hub", "soup"):
        file, stream = mesh + (".mesh" if mesh == "solid" else ".ply"), mesh + ".vsm"
        yield "info", "--full", file
        yield "info", "--check", stream
        for order in ("bfs", "spectral", "axis", "keep"):
            yield "convert", file, "out/o.vsm", "--order", order
        yield "convert", stream, "out/o.vtu", "--restore-order"
        if mesh != "solid":
            yield "convert", file, "out/o.vsm", "--orient", "--weld", "0"
            yield "smooth", stream, "out/o.vsm", "--steps", "5", "--keep-edges", "30", "--orient"
        for out in ("out/o.vsm", "out/o.vtu"):
            yield "solve", stream, out, "--problem", "problem.json", "--tolerance", "1e-12"
        yield "deform", stream, "out/o.vsm", "--handles", "handles.json"
        if mesh in ("hub", "soup"):
            yield "smooth", stream, "out/o.vsm", "--column", "value"
            yield "blend", stream, "out/o.vsm", "--patch", "patch", "--columns", "value"
        first = json.dumps({"nearest": [[1, 0, 0]]})
        for accuracy in ("exact", "approximate") if mesh != "solid" else ("approximate",):
            yield "distance", stream, "out/o.vsm", "--from", first, "--accuracy", accuracy, "--source", "--direction"
        yield "distance", stream, "out/o.vsm", "--from", '{"halfspace": [1, 0, 0, 0.3]}'
        if mesh == "solid":
            yield "distance", stream, "out/o.vsm", "--wall"
        yield "area", stream, "out/o.vsm", "--of", '{"halfspace": [1, 0, 0, 0.3]}'
        yield "simplify", file, "out/o.ply", "--vertices", "100"
        yield "preview", file, "out/o.vtp", "--points", "1000"


def begin(arguments):
    """Starts smg, and returns when it catches signals."""
    process = subprocess.Popen([SMG, *arguments, "--no-sync", "--scratch", "scratch"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, env=dict(os.environ, TMPDIR="temporary"))
    bit = 1 << (signal.SIGTERM - 1)
    while process.poll() is None:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            caught = re.search(r"SigCgt:\s*(\w+)", status.read())
        if caught and int(caught[1], 16) & bit:
            break
        time.sleep(0.001)
    return process


def remains():
    return [os.path.join(folder, name) for folder in FOLDERS for name in os.listdir(folder)]


def clear():
    for path in remains():
        shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def lateness(arguments, kind, moment):
    """How long the command takes to end after the signal; none: it had ended before."""
    process = begin(arguments)
    try:
        process.wait(moment)
    except subprocess.TimeoutExpired:
        pass
    is_over = process.returncode is not None
    sent = time.monotonic()
    process.send_signal(kind)
    _, error = process.communicate(timeout=600)
    late = time.monotonic() - sent
    if is_over or process.returncode in (0, 1, 3):
        clear()
        return None
    assert process.returncode == 128 + kind, (arguments, moment, process.returncode, error)
    error = re.sub(PROGRESS, "", error)  # of slow commands
    # What is wrong with the mesh may be found at the same moment.
    assert error.startswith("smg: ") and error.count("\n") == 1, (arguments, moment, error)
    assert not remains(), (arguments, moment, remains())
    return late


def earliest(arguments, kind, moment):
    """The best of some tries, if there is one that was not over."""
    lates = []
    while len(lates) < TRIES and (not lates or lates[-1] > LATEST):
        late = lateness(arguments, kind, moment)
        if late is None:
            return None
        lates.append(late)
    assert lates[-1] <= LATEST, (arguments, kind, moment, lates)
    return lates[-1]


def duration(arguments):
    """How long the command takes, at most LONGEST. It may fail: some meshes are too odd for it."""
    start = time.monotonic()
    process = begin(arguments)
    try:
        _, error = process.communicate(timeout=LONGEST)
        assert process.returncode in (0, 1, 3), (arguments, process.returncode, error)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
    clear()
    return time.monotonic() - start


def main():
    for folder in FOLDERS:
        os.makedirs(folder, exist_ok=True)
    clear()
    write_meshes()
    table = list(commands())
    listed = re.findall(r"^  (\w+) ", run("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
    assert listed and set(listed) == {name for name, *_ in table}, listed
    numbers, stops, worst = random.Random(7), 0, 0.0
    for at, arguments in enumerate(table):
        whole = duration(arguments)
        for k in range(MOMENTS):
            moment, kind = whole * numbers.random(), (signal.SIGINT, signal.SIGTERM)[(at + k) % 2]
            late = earliest(arguments, kind, moment)
            while late is None and moment > 0.001:  # it has been faster than when its duration was measured
                moment *= 0.3
                late = earliest(arguments, kind, moment)
            stops += late is not None
            worst = max(worst, late or 0.0)
    assert stops > len(table) // 2, stops
    print(f"{stops} stops of {len(table)} commands, the latest after {worst:.2f} s")


if __name__ == "__main__":
    main()
