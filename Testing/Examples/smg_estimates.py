#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""--dry-run of the commands: nothing is read or written, and the truth is near the estimate.

For every format and every command, on a surface and a solid: result and scratch files are 0.8 to 1.5 times the truth.
Memory is within a factor of 2, passes within 1.5."""

import math
import json
import os
import random
import shutil

from program import load, run, write_medit, write_torus
from small_disk import SmallDisk, can_mount
from tetrahedra import tetrahedra
from torus import torus

FIRST = '{"nearest": [[-9, 0, 0]]}'
MIB = 1 << 20
LEAST, MOST = 0.8, 1.5
WITH_COLUMNS = {"surface": ("vsm", "ply", "vtp", "vtu", "vtkhdf"), "solid": ("vsm", "vtu", "vtkhdf")}
STREAMS = {"surface": ("sma", "smb"), "solid": ("sva", "svb")}
RESTORED = {"surface": ("obj", "off", "stl", "mesh", "msh", "node", "inp", "e"), "solid": ("mesh", "msh", "node", "inp", "e")}


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def write_tasks():
    held = '"dirichlet": [{"halfspace": [-1, 0, 0, %s], "value": %s}, {"halfspace": [1, 0, 0, %s], "value": %s}]'
    for mesh, low, high in (("surface", 2.8, 2.8), ("solid", -0.3, WIDTH - 1.3)):
        write(mesh + "-one.json", "{%s}" % (held % (low, 0, high, 1)))
        write(mesh + "-three.json", '{"columns": 3, "outputs": ["gradient", "flux"], %s}'
              % (held % (low, [0, 0, 0.7], high, [1, 2.3, -3])))
        write(mesh + "-handles.json", '{"handles": [{"region": {"halfspace": [-1, 0, 0, %s]}, "fixed": true}, '
              '{"region": {"halfspace": [1, 0, 0, %s]}, "rotate": {"axis": [1, 0, 0], "degrees": 60, "center": [0, 0, 0]}}]}' % (low, high))


def write_surface(name, nu, nv):
    """A rough torus with normals and colours, in two patches, as a PLY file."""
    points, quadrangles = torus(nu, nv)
    noise = random.Random(1)
    with open(name, "w", encoding="ascii") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points))
        file.writelines("property float %s\n" % axis for axis in ("x", "y", "z", "nx", "ny", "nz"))
        file.writelines("property uchar %s\n" % color for color in ("red", "green", "blue", "patch"))
        file.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (2 * len(quadrangles)))
        for x, y, z in points:
            x, y, z = (c + noise.uniform(-0.002, 0.002) for c in (x, y, z))
            color = (int(100 + 50 * x / 3 + noise.uniform(0, 9)), int(90 + 30 * z), noise.randrange(256))
            file.write("%.9g %.9g %.9g %.9g %.9g %.9g %d %d %d %d\n" % (x, y, z, x / 3, y / 3, z, *color, x > 0))
        for a, b, c, d in quadrangles:
            file.write("3 %d %d %d\n3 %d %d %d\n" % (a, b, c, a, c, d))


def write_solid(name, n):
    """A cube of uneven tetrahedra, as a Medit file."""
    points, cells = tetrahedra(n)
    noise = random.Random(2)
    write_medit(name, [tuple(c + noise.uniform(-0.1, 0.1) for c in point) for point in points], cells)


def arguments_of(command, mesh):
    """Those of a command, besides IN and OUT."""
    return {"solve": ["--problem", mesh + "-three.json"], "deform": ["--handles", mesh + "-handles.json", "--cycles", "2"],
            "distance": ["--from", FIRST], "smooth": [], "convert": [],
            "blend": ["--patch", "patch" if mesh == "surface" else "DistanceSource",
                      "--columns", "Colors" if mesh == "surface" else "Distance"]}[command]


def cases():
    """Every command and every format: the mesh, the command, IN, the suffix of OUT, and options."""
    for mesh in ("surface", "solid"):
        for suffix in WITH_COLUMNS[mesh] + ("vtk",):
            for command in ("solve", "distance", "blend"):
                yield mesh, command, mesh + ".vsm", suffix, []
        for suffix in WITH_COLUMNS[mesh] + STREAMS[mesh] + ("vtk",) + RESTORED[mesh]:
            yield mesh, "deform", mesh + ".vsm", suffix, []
            if mesh == "surface":
                yield mesh, "smooth", mesh + ".vsm", suffix, []
            restores = suffix in RESTORED[mesh] + ("vtk",)
            yield mesh, "convert", mesh + ".vsm", suffix, ["--restore-order"] if restores else []
    # Files that are converted first, whose order is restored or that are written again; checkpoints.
    for command, file, suffix in (("solve", "surface.ply", "vsm"), ("solve", "surface.ply", "ply"),
                                  ("distance", "surface.ply", "vtp"), ("blend", "surface.ply", "off"),
                                  ("deform", "surface.ply", "ply"), ("deform", "surface.ply", "stl"),
                                  ("deform", "surface.smb", "sma"), ("solve", "surface.smb", "vtkhdf"),
                                  ("convert", "surface.ply", "vsm"), ("convert", "surface.ply", "vtp"),
                                  ("convert", "surface.smb", "ply")):
        yield "surface", command, file, suffix, []
    for command, file, suffix in (("solve", "surface.vsm", "vsm"), ("deform", "surface.vsm", "stl"),
                                  ("solve", "surface.ply", "ply"), ("solve", "solid.vsm", "vtk")):
        yield file.split(".")[0], command, file, suffix, ["--checkpoint", "checkpoint"]
    for order, codec in (("keep", "lz4"), ("axis", "none"), ("spectral", "zstd")):
        yield "surface", "convert", "surface.vsm", "vsm", ["--order", order, "--codec", codec]
    for memory in ("16", "1024"):
        yield "solid", "convert", "solid.vsm", "vsm", ["--memory", memory]


def test_previews():
    for file, out in (("surface.vsm", "p.vsm"), ("surface.vsm", "p.ply"), ("surface.ply", "p.vtp"), ("solid.vsm", "p.ply")):
        remove(out)
        shown = run("preview", file, out, "--points", 2000, "--dry-run", "--report", "report.json").stdout
        said = load("report.json")
        assert "passes   about 1" in shown and said["counted"] and not os.path.exists(out), shown
        run("preview", file, out, "--points", 2000, "--quiet")
        truth = bytes_of(out)
        assert 0.6 * truth < said["output_bytes"] < 1.7 * truth, (file, out, truth, said)


def bytes_of(out):
    return os.path.getsize(out) + (os.path.getsize("o.ele") if out == "o.node" else 0)


def remove(out):
    for name in (out, "o.ele"):
        if os.path.exists(name):
            os.remove(name)


def test_formats():
    """Result and scratch files of all commands and formats are as large as --dry-run says."""
    wrong = []
    for mesh, command, file, suffix, options in cases():
        out = "o." + suffix
        common = [command, file, out, *arguments_of(command, mesh), *options, "--report", "report.json"]
        remove(out)
        run(*common, "--dry-run")
        assert not os.path.exists(out)
        said = load("report.json")
        assert said["counted"]
        run(*common, "--quiet")
        done = load("report.json")
        for what, truth, estimate in (("output", bytes_of(out), said["output_bytes"]),
                                      ("scratch", done["scratch_bytes_peak"], said["scratch_bytes"])):
            if not LEAST * truth <= estimate <= MOST * truth + (64 << 10):
                wrong.append((mesh, command, file, suffix, *options, what, truth, estimate, estimate / max(truth, 1)))
        remove(out)
    assert not wrong, "\n".join(map(str, wrong))


def test_peak():
    """The report tells the most scratch files that there were: with a limit of a MiB more the command succeeds, with
    less it does not."""
    for command, suffix in (("solve", "vtkhdf"), ("deform", "stl"), ("convert", "ply")):
        common = [command, "surface.vsm", "o." + suffix, *arguments_of(command, "surface"), "--quiet", "--threads", "1"]
        run(*common, "--report", "report.json")
        most = load("report.json")["scratch_bytes_peak"] // MIB
        run(*common, "--scratch-limit", most + 1)
        remove("o." + suffix)
        assert "--scratch-limit" in run(*common, "--scratch-limit", most, code=1).stderr
        assert not os.path.exists("o." + suffix)


def commands(mesh):
    """Names of commands and their arguments."""
    yield "solve", ["--problem", mesh + "-one.json"]
    yield "solve", ["--problem", mesh + "-three.json", "--tolerance", "1e-9"]
    yield "deform", ["--handles", mesh + "-handles.json", "--cycles", "3"]
    yield "distance", ["--from", FIRST]
    if mesh == "surface":
        yield "smooth", []
        yield "smooth", ["--orient"]


def test_costs(mesh, command, arguments, threads):
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
            ("passes", done["passes"], said["passes"], 1.5)):
        assert 1 / factor <= estimate / truth <= factor, (mesh, command, arguments, threads, what, truth, estimate)
    assert said["cpu_seconds"] > 0 and said["memory_limit"] == 1024 * MIB
    os.remove("o.vsm")


def test_simplifications():
    """Also of many columns; what does not fit according to --dry-run does not, and says what takes the memory."""
    columns = "".join("property double c%d\n" % k for k in range(40))
    points, quadrangles = torus(220, 190)
    with open("wide.ply", "w", encoding="ascii") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(points) + "property double x\nproperty double y\n"
                   "property double z\n" + columns + "element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                   % len(quadrangles))
        file.writelines("%r %r %r" % point + " 0" * 40 + "\n" for point in points)
        file.writelines("4 %d %d %d %d\n" % quadrangle for quadrangle in quadrangles)
    run("convert", "wide.ply", "wide.vsm", "--quiet")
    with open("held.json", "w", encoding="ascii") as file:
        json.dump({"vertices": list(range(0, len(points), 2))}, file)
    for mesh, *hold in (("surface",), ("solid",), ("wide",), ("wide", "--hold", "held.json")):
        for memory in (16, 17, 24, 64, 256):
            common = ["simplify", mesh + ".vsm", "small.vsm", "--vertices", "2000", "--memory", memory, *hold]
            run(*common, "--dry-run", "--report", "dry.json")
            said = load("dry.json")["memory_bytes"]
            if hold and 1 < said / (memory * MIB) < 1.25:  # how many are held at once is not known
                continue
            done = run(*common, "--quiet", "--report", "report.json", code=int(said > memory * MIB))
            if said > memory * MIB:
                words = ["so many columns needs at least", "so many vertices stay, needs at least"][: 1 + len(hold)]
                assert any(each in done.stderr for each in words) and "order" not in done.stderr, done.stderr
                continue
            peak = load("report.json")["pool_bytes_peak"]
            assert peak / 2 <= said <= 2 * peak, (mesh, memory, peak, said)


def test_winding():
    """The reading that finds how to wind the triangles is counted."""
    def passes(*options):
        run("smooth", "surface.vsm", "o.vsm", *options, "--dry-run", "--report", "dry.json")
        return load("dry.json")["passes"]

    assert passes("--orient") == passes() + 1


def test_room():
    """Disks that are too small are refused before anything is done, with both figures."""
    with SmallDisk("small", MIB) as disk:
        for arguments in (["solve", "surface.vsm", "o.vsm", "--problem", "surface-one.json", "--scratch", disk],
                          ["solve", "surface.vsm", disk + "/o.ply", "--problem", "surface-three.json"],
                          ["convert", "surface.vsm", disk + "/o.stl", "--restore-order"]):
            said = run(*arguments, code=1).stderr
            assert disk in said and "MiB, there is room for" in said, said
            assert os.listdir(disk) == [] and not os.path.exists("o.vsm")


def test_tight_room():
    """What just fits is not refused; what certainly does not, is."""
    task = ["--problem", "surface-three.json", "--quiet"]
    run("solve", "surface.vsm", "o.vtp", *task, "--report", "report.json")
    for size, scratch in ((os.path.getsize("o.vtp"), False), (load("report.json")["scratch_bytes_peak"], True)):
        for factor, code in ((1.1, 0), (0.5, 1)):
            with SmallDisk("tight", int(factor * size)) as disk:
                places = ["o.vtp", "--scratch", disk] if scratch else [disk + "/o.vtp"]
                done = run("solve", "surface.vsm", *places, *task, code=code)
                assert (", there is room for" in done.stderr) == (code == 1), done.stderr
    os.remove("o.vtp")


def test_threads():
    """Tasks of several threads need memory between them, and longer steps for many more; --dry-run counts both."""
    def memory(threads):
        run("solve", "surface.vsm", "o.vsm", "--problem", "surface-three.json", "--dry-run", "--threads", threads, "--report",
            "dry.json")
        return load("dry.json")["memory_bytes"]

    assert memory("1") < memory("2") == memory("4") < memory("8") == memory("16")


def test_limits_below_the_need():
    common = ("solve", "surface.vsm", "o.vsm", "--problem", "surface-one.json", "--dry-run")
    assert "raise" not in run(*common).stdout
    shown = run(*common, "--memory", 1, "--scratch-limit", 1).stdout
    assert shown.count("the limit is 1 MiB, which is too low: raise --") == 2, shown


def test_unconverted():
    """Of a file that does not tell its counts these are estimated, too."""
    write_torus("torus.obj", 300, 150)
    run("solve", "torus.obj", "o.ply", "--problem", "surface-one.json", "--dry-run", "--report", "dry.json")
    said = load("dry.json")
    run("solve", "torus.obj", "o.ply", "--problem", "surface-one.json", "--quiet", "--report", "report.json")
    done = load("report.json")
    assert not said["counted"] and said["passes"] <= 1.5 * done["passes"]
    for truth, estimate in ((done["pool_bytes_peak"], said["memory_bytes"]),
                            (done["scratch_bytes_peak"], said["scratch_bytes"]),
                            (os.path.getsize("o.ply"), said["output_bytes"])):
        assert abs(math.log2(estimate / truth)) <= 2, (truth, estimate)


def write_meshes():
    write_surface("surface.ply", 220, 190)
    write_solid("solid.mesh", WIDTH)
    run("convert", "surface.ply", "surface.vsm", "--quiet")
    run("convert", "surface.vsm", "surface.smb", "--order", "keep", "--quiet")
    run("convert", "solid.mesh", "plain.vsm", "--quiet")
    # With columns that can be blended, of four parts.
    corners = '{"nearest": [[0, 0, 0], [%d, 0, 0], [0, %d, 0], [0, 0, %d]]}' % ((WIDTH,) * 3)
    run("distance", "plain.vsm", "solid.vsm", "--from", corners, "--source", "--quiet")


if os.path.exists("o.vsm"):  # of an earlier failed run
    os.remove("o.vsm")
shutil.rmtree("checkpoint", ignore_errors=True)
WIDTH = 30
write_meshes()
write_tasks()
test_formats()
test_peak()
for each in ("surface", "solid"):
    for task in commands(each):
        for count in ("2", "8"):
            test_costs(each, *task, count)
test_simplifications()
test_previews()
test_threads()
test_limits_below_the_need()
test_unconverted()
if can_mount():
    test_room()
    test_tight_room()
