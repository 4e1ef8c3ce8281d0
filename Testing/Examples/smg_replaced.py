#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A file that is replaced while a command uses it: for every command, every kind of file that it
opens more than once and every opening, by a rename or in place. The other content is the same mesh in
another order. The result is that of one of both, or there is an error that names the file: never a
mixture of both."""

import json
import os
import random
import shutil
import subprocess

from program import Combinations, SMG, run, write_medit, write_ply
from tetrahedra import tetrahedra
from torus import torus

LIBRARY = os.environ["SMG_REPLACED_LIBRARY"]
STREAMED = ("--core-nodes", "300", "--block-nodes", "600", "--threads", "1")
TOP = '{"halfspace": [0, 0, 1, 0.9]}'


def shuffled(points, cells, seed):
    """The same mesh with points and cells in another order, and the old number of each point."""
    chance = random.Random(seed)
    order = list(range(len(points)))
    chance.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    cells = [tuple(place[corner] for corner in cell) for cell in cells]
    chance.shuffle(cells)
    return [points[old] for old in order], cells, order


def write_meshes():
    """Folders a and b with the same meshes in different orders, in each kind of file."""
    surface, solid = torus(60, 40), tetrahedra(9)
    solid = [tuple(x / 4 - 1 for x in point) for point in solid[0]], solid[1]
    for entry in os.listdir("."):  # remains of an earlier run
        shutil.rmtree(entry) if os.path.isdir(entry) else os.remove(entry)
    for folder, seed in (("a", 1), ("b", 2)):
        os.mkdir(folder)
        points, cells, _ = shuffled(*surface, seed)
        write_ply(folder + "/t.ply", points, cells, {
            "heat": ("double", [x + 3 * (y > 0) for x, y, _ in points]),
            "patch": ("int", [int(y > 0) for _, y, _ in points])})
        points, cells, _ = shuffled(*solid, seed)
        write_medit(folder + "/s.mesh", points, cells)
        run("convert", folder + "/t.ply", folder + "/t.vsm", "--order", "axis" if seed == 1 else "bfs",
            "--quiet")
        run("convert", folder + "/s.mesh", folder + "/s.vsm", "--quiet")
        for name in ("t.obj", "t.sma", "t.smb", "s.node", "s.vtu"):
            run("convert", folder + "/" + name[0] + ".vsm", folder + "/" + name, "--quiet")
        with open(folder + "/s.pvtu", "w", encoding="utf-8") as file:
            file.write('<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>'
                       '<Piece Source="s.vtu"/></PUnstructuredGrid></VTKFile>\n')
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump({"dirichlet": [{"halfspace": [0, 0, 1, 0.9], "value": [1]},
                                 {"halfspace": [0, 0, -1, 0.9], "value": [0]}]}, file)
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": json.loads(TOP), "translate": [0, 0, 0.5]},
                               {"region": {"halfspace": [0, 0, -1, 0.9]}, "fixed": True}]}, file)


def jobs():
    """Commands and the file that is replaced, by their names in the folders a and b."""
    solve = ("--problem", "../problem.json", *STREAMED)
    smooth = ("--size", "4edges", *STREAMED)
    for suffix in (".vsm", ".vtp"):
        yield ("solve", "t.vsm", "out" + suffix, *solve), "t.vsm"
    yield ("deform", "t.vsm", "out.vsm", "--handles", "../handles.json", *STREAMED), "t.vsm"
    yield ("smooth", "t.vsm", "out.vsm", *smooth), "t.vsm"
    yield ("smooth", "t.vsm", "out.obj", *smooth), "t.vsm"
    yield ("smooth", "t.vsm", "out.vsm", "--column", "heat", *smooth), "t.vsm"
    yield ("distance", "t.vsm", "out.vsm", "--from", TOP, "--source", "--direction", "--threads", "1"), "t.vsm"
    yield ("blend", "t.vsm", "out.vsm", "--patch", "patch", "--columns", "heat", *STREAMED), "t.vsm"
    yield ("simplify", "t.vsm", "out.vsm", "--vertices", "300"), "t.vsm"
    yield ("preview", "t.vsm", "out.vtp", "--points", "500"), "t.vsm"
    yield ("preview", "s.vsm", "out.vtp", "--points", "500"), "s.vsm"
    yield ("info", "t.vsm", "--full"), "t.vsm"
    for order in ("keep", "bfs"):
        yield ("convert", "t.vsm", "out.vsm", "--order", order), "t.vsm"
    for suffix in (".ply", ".sma", ".vtkhdf"):
        yield ("convert", "t.vsm", "out" + suffix, "--order", "keep"), "t.vsm"
    yield ("convert", "t.vsm", "out.ply", "--restore-order"), "t.vsm"
    for name in ("t.ply", "t.obj", "t.sma", "t.smb"):
        yield ("convert", name, "out.vsm"), name
        yield ("smooth", name, "out" + name[1:], *smooth), name
    yield ("solve", "t.ply", "out.vtp", *solve), "t.ply"
    yield ("solve", "s.mesh", "out.vtu", *solve), "s.mesh"
    for name in ("s.node", "s.ele"):
        yield ("convert", "s.node", "out.vsm"), name
    yield ("solve", "s.pvtu", "out.vtu", *solve), "s.vtu"


def outcome(arguments, environment=None):
    """Exit code, result and error of a command in the folder `now`."""
    done = subprocess.run([SMG, *arguments, "--quiet"] if arguments[0] != "info" else [SMG, *arguments],
                          capture_output=True, cwd="now", timeout=600, check=False,
                          env={**os.environ, **(environment or {})})
    if arguments[0] == "info":
        return done.returncode, done.stdout, done.stderr.decode()
    result = None
    if os.path.exists("now/" + arguments[2]):
        with open("now/" + arguments[2], "rb") as file:
            result = file.read()
    return done.returncode, result, done.stderr.decode()


def begin(name=None):
    """The folder `now` with the files of a, and with that of b for `name`."""
    shutil.rmtree("now", ignore_errors=True)
    shutil.copytree("a", "now")
    if name:
        shutil.copy("b/" + name, "now/" + name)


def replacing(name, place, how):
    return {"LD_PRELOAD": LIBRARY, "SMG_REPLACED": os.path.abspath("now/" + name),
            "SMG_REPLACED_BY": os.path.abspath("b/" + name), "SMG_REPLACED_AT": str(place),
            "SMG_REPLACED_HOW": how, "SMG_REPLACED_COUNT": os.path.abspath("count")}


def test_all():
    write_meshes()
    combinations = Combinations()
    mixed, runs, errors = [], 0, 0
    for arguments, name in jobs():
        expected = []
        for other in (None, name):
            begin(other)
            code, result, error = outcome(arguments, replacing(name, "never", "rename"))
            assert other or code == 0, (arguments, error)
            # Half of a pair of files alone may be no mesh.
            expected.append(result if code == 0 else None)
        assert expected[0] != expected[1], arguments
        with open("count", encoding="utf-8") as file:
            openings = int(file.read())
        for how in ("rename", "write"):
            for place in ("every", *range(1, openings + 1)):
                if not combinations.next():
                    continue
                begin()
                code, result, error = outcome(arguments, replacing(name, place, how))
                runs += 1
                errors += code != 0
                if not ((code == 0 and result in expected) or
                        (code == 1 and error.count("\n") == 1 and name in error and
                         (result is None or arguments[0] == "info"))):
                    mixed.append((arguments[:3], name, how, place, code, error))
    assert not mixed, (len(mixed), runs, mixed)
    print("%d runs, %d of them ended with an error" % (runs, errors))


test_all()
