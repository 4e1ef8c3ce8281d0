#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The program smg as a black box: commands, reports, exit codes and remaining files."""

import csv
import json
import os
import resource
import shutil
import signal
import stat
import subprocess
import sys
import time

from mesh_files import read_mesh, same_points
from program import SMG, load, read_vtk_xml, run, write_torus


def test_convert_and_info():
    write_torus("torus.obj", 120, 60)
    done = run("convert", "torus.obj", "torus.vsm", "--report", "convert.json")
    assert "7200 vertices" in done.stdout and done.stderr == ""
    report = load("convert.json")
    assert report["vertices"] == 7200 and report["cells"] == 14400
    assert report["triangulated_polygons"] == 7200 and report["components"] == 1
    assert report["boundary_edges"] == 0 and 0 < report["width"] <= 400
    assert run("info", "torus.vsm", "--report", "info.json", "--quiet").stdout == ""
    info = load("info.json")
    assert info["vertices"] == 7200 and info["cells"] == 14400
    assert info["width"] == report["width"] and info["span"] == report["span"]
    assert all(abs(a - b) < 1e-6 for a, b in zip(info["bounds"], (-3, 3, -3, 3, -1, 1)))
    assert "OriginalId" in [column["name"] for column in info["columns"]["vertices"]]
    assert "width" in run("info", "torus.obj").stdout
    for name in ("torus.smb", "torus.sma", "torus.vtp", "torus.vtu"):
        run("convert", "torus.vsm", name, "--order", "keep", "--quiet")
    assert "14400" in run("info", "torus.smb").stdout


def test_vtk_xml():
    """The written file is the mesh, and VTK's readers read the same."""
    with open("torus.obj", encoding="utf-8") as file:
        points = [tuple(map(float, line.split()[1:])) for line in file if line.startswith("v ")]
    surface, grid = read_vtk_xml("torus.vtp"), read_vtk_xml("torus.vtu")
    assert grid.pop("types") == [(5,)] * 14400
    assert surface == grid
    assert surface["offsets"] == [(3 * i + 3,) for i in range(14400)]
    assert surface["Points"] == [points[id] for id, in surface["OriginalId"]]
    for name in ("torus.vtp", "torus.vtu"):
        run("convert", name, "back.vsm", "--order", "keep", "--quiet")
        run("convert", "back.vsm", "back.vtp", "--order", "keep", "--quiet")
        assert read_vtk_xml("back.vtp") == surface, name


def problem(**members):
    with open("problem.json", "w", encoding="utf-8") as file:
        json.dump(members, file)
    return "problem.json"


def test_solve():
    ends = [{"halfspace": [1, 0, 0, 2.8], "value": "position"},
            {"halfspace": [-1, 0, 0, 2.8], "value": [0, 0, 1]}]
    name = problem(weights="cotangent", columns=3, dirichlet=ends)
    run("solve", "torus.vsm", "solved.vsm", "--problem", name, "--report", "solve.json")
    report = load("solve.json")
    assert report["converged"] and report["residuals"][-1] <= 1e-6
    assert report["passes"] == report["cycles"] + 1 and report["vertices"] == 7200
    run("info", "solved.vsm", "--report", "info.json")
    columns = {c["name"]: c for c in load("info.json")["columns"]["vertices"]}
    assert columns["Solution"]["type"] == "float64" and columns["Solution"]["components"] == 3
    assert "OriginalId" in columns
    run("solve", "torus.obj", "solved.vtp", "--problem", name, "--quiet", "--report", "solve.json")
    assert load("solve.json")["seconds"]["convert"] > 0
    run("convert", "solved.vsm", "restored.vtp", "--restore-order", "--quiet")
    assert read_vtk_xml("solved.vtp") == read_vtk_xml("restored.vtp")
    run("solve", "solved.vsm", "again.vsm", "--problem", name, "--in-core", "--threads", 1,
        "--block-nodes", 333, "--core-nodes", 100, "--quiet")
    with open("solved.vsm", "rb") as streamed, open("again.vsm", "rb") as core:
        assert streamed.read() == core.read(), "streaming and in-core results differ"
    done = run("solve", "torus.vsm", "o.vsm", "--problem", name, "--max-cycles", 1, "--quiet",
               "--report", "solve.json", code=3)
    assert "not converged" in done.stderr and not load("solve.json")["converged"]
    assert done.stderr.count("--max-cycles") == 1, done.stderr
    done = run("solve", "torus.vsm", "o.vsm", "--problem", name, "--operators", "shi2006", code=2)
    assert "solve_shi2006" in done.stderr, done.stderr
    assert "shi2006" not in run("deform", "--help").stdout
    assert "KiB to TiB" in run("preview", "--help").stdout


def test_solutions_have_the_order_of_their_mesh():
    name = problem(dirichlet=[{"halfspace": [1, 0, 0, 2.8], "value": 1},
                              {"halfspace": [-1, 0, 0, 2.8], "value": 0}])
    mesh = read_mesh("torus.obj")
    run("convert", "torus.vsm", "torus.ply", "--restore-order", "--quiet")
    run("convert", "torus.vsm", "numbered.vtu", "--order", "keep", "--quiet")
    run("solve", "torus.vsm", "stream.vtp", "--problem", name, "--quiet")
    stream = read_vtk_xml("stream.vtp")
    solution = {id: value for (id,), value in zip(stream["OriginalId"], stream["Solution"])}
    for source, out in (("torus.obj", "o5.vtp"), ("torus.ply", "o5.ply"), ("torus.ply", "o5.vtu")):
        done = run("solve", source, out, "--problem", name)
        assert "stream order" not in done.stdout, done.stdout
        solved = read_mesh(out)
        assert same_points(solved.points, mesh.points), (source, out)
        assert solved.cells == mesh.cells, (source, out)
        if out != "o5.ply":
            arrays = read_vtk_xml(out)
            assert arrays["Solution"] == [solution[i] for i in range(7200)], (source, out)
            assert "OriginalId" not in arrays and "OriginalCellId" not in arrays
    run("info", "o5.ply", "--report", "info.json", "--quiet")
    assert "Solution" in [c["name"] for c in load("info.json")["columns"]["vertices"]]
    # Meshes with the numbers of another file, or with merged points, keep the order of the stream.
    done = run("solve", "numbered.vtu", "o5.vtu", "--problem", name)
    assert "The vertices are in stream order.\n" in done.stdout, done.stdout
    assert sorted(read_vtk_xml("o5.vtu")["OriginalId"]) == [(i,) for i in range(7200)]
    done = run("solve", "torus.obj", "o5.ply", "--problem", name, "--weld", 0)
    assert "OriginalId names their places in torus.obj" in done.stdout, done.stdout


def test_the_commands_are_listed():
    for arguments, code in (((), 2), (("help",), 0), (("--help",), 0)):
        done = subprocess.run([SMG, *arguments], capture_output=True, text=True, timeout=1200)
        said, other = (done.stderr, done.stdout) if code else (done.stdout, done.stderr)
        assert done.returncode == code and other == "", arguments
        for command in ("info", "convert", "solve", "deform", "smooth", "blend", "distance", "preview"):
            assert f"\n  {command}  " in said, (arguments, command, said)


def test_errors():
    assert "foo" in run("foo", code=2).stderr
    run("solve", "torus.vsm", "o.vsm", code=2)
    run("solve", "torus.vsm", "o.vsm", "--problem", "problem.json", "--operators", "foo", code=2)
    for wrong in (("--weld", -1), ("--weld", "nan"), ("--weld", "1x"), ("--time-step", 1.5),
                  ("--time-step", -1), ("--partition", "first")):
        said = run("convert", "torus.obj", "o2.vsm", *wrong, code=2).stderr
        assert "'%s' is not" % wrong[1] in said and len(said) < 120, said
    for command in (("info", "torus.vsm"), ("preview", "torus.vsm", "o2.vtp")):
        assert "read as it is" in run(*command, "--weld", 0, code=1).stderr, command
    for report in (".", os.path.join("nowhere", "r.json")):
        for command in (("info", "torus.vsm"), ("convert", "torus.obj", "o2.vsm"),
                        ("solve", "torus.vsm", "o2.vsm", "--problem", "problem.json")):
            run(*command, "--report", report, code=1)
    run("convert", "torus.obj", "o2.vsm", "--order", "random", code=2)
    run("convert", "missing.ply", "o2.vsm", code=1)
    run("convert", "torus.obj", "o2.xyz", code=1)
    run("convert", "torus.obj", "o2.svb", code=1)
    run("convert", "torus.obj", "o2.vsm", "--memory", 1, code=1)
    open("empty.vsm", "wb").close()
    run("info", "empty.vsm", code=1)
    for members, place in (({"sweeps": 1}, "sweeps"), ({"columns": 0}, "columns"),
                           ({"dirichlet": [{"box": [1], "value": [0]}]}, "dirichlet[0].box"),
                           ({"dirichlet": [{"sphere": [9, 9, 9, 1], "value": [0]}]},
                            "dirichlet[0]"),
                           ({"dirichlet": [{"vertices": [7200], "value": [0]}]}, "7200")):
        done = run("solve", "torus.vsm", "o2.vsm", "--problem", problem(**members), code=1)
        assert place in done.stderr, done.stderr
    name = problem(dirichlet=[{"sphere": [0, 0, 0, 1.5], "value": [0]}])
    done = run("solve", "torus.vsm", "o2.vsm", "--problem", name, "--memory", 1, code=1)
    assert "1 MiB" in done.stderr, done.stderr
    error = run("solve", "torus.vsm", "o2.smb", "--problem", name, code=1).stderr
    assert "cannot hold a solution: write it as .vsm, .ply, .msh, .e, .exo, .ex2, .g, .vtk, .vtp, .vtu" in error, error
    error = run("solve", "torus.obj", "o2.xyz", "--problem", name, code=1).stderr
    assert ".vsm" in error and ".vtk," in error and ".smb" not in error, error
    error = run("smooth", "torus.obj", "o2.xyz", "--weld", 0.1, code=1).stderr
    assert "this is not a format of a result: write it as .vsm" in error and ".stl" in error, error
    error = run("convert", "torus.obj", "o2.vsm", "--weld", 1000, code=1).stderr
    assert "in the unit of the mesh?" in error, error
    # A limit of the size of files is an error, which leaves nothing.
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))
    done = subprocess.run([SMG, "convert", "torus.obj", "o2.vsm"], capture_output=True, text=True,
                          preexec_fn=limit)
    assert done.returncode == 1 and "File too large" in done.stderr, done
    # The folder of OUT is checked before anything is read.
    for command in (("convert", "empty.vsm", "nowhere/o.vsm"), ("preview", "empty.vsm", "nowhere/o.vtp"),
                    ("convert", "empty.vsm", "nowhere/o.obj", "--restore-order"),
                    ("solve", "empty.vsm", "nowhere/o.vtp", "--problem", name),
                    ("deform", "empty.vsm", "nowhere/o.ply", "--handles", name)):
        assert "there is no folder nowhere" in run(*command, code=1).stderr, command
    # The problem is read before the mesh.
    for file in ("missing.json", "scratch"):
        os.makedirs("scratch", exist_ok=True)
        done = run("solve", "missing.obj", "o2.vsm", "--problem", file, code=1)
        assert file in done.stderr, done.stderr
    assert not any(file.startswith("o2") for file in os.listdir("."))


def link(target, name):
    """A symbolic link instead of that of the previous run."""
    if os.path.lexists(name):
        os.remove(name)
    os.symlink(target, name)


def test_files_of_the_command_are_not_overwritten():
    name = problem(dirichlet=[{"sphere": [0, 0, 0, 9], "value": [0]}])
    link("torus.vsm", "link.vsm")
    link("o3.vsm", "to_be_made.vsm")
    shutil.copy(name, "problem.vsm")
    before = {file: open(file, "rb").read() for file in ("torus.obj", "torus.vsm", name, "problem.vsm")}
    solve = ("--problem", name)
    for command in (("info", "torus.obj", "--report", "torus.obj"),
                    ("info", "torus.vsm", "--report", "link.vsm"),
                    ("convert", "torus.obj", "o3.vsm", "--report", "o3.vsm"),
                    ("preview", "torus.obj", "o3.vsm", "--report", "./o3.vsm"),
                    ("convert", "torus.obj", "o3.vsm", "--report", "to_be_made.vsm"),
                    ("solve", "torus.vsm", "o3.vsm", *solve, "--report", name),
                    ("preview", "torus.vsm", "link.vsm"),
                    ("convert", "torus.vsm", "torus.vsm", "--order", "keep"),
                    ("solve", "torus.vsm", "torus.vsm", *solve),
                    ("solve", "torus.vsm", "problem.vsm", "--problem", "problem.vsm"),
                    ("deform", "torus.vsm", "problem.vsm", "--handles", "problem.vsm"),
                    ("solve", "torus.vsm", "link.vsm", *solve),
                    ("solve", "torus.vsm", "o3.vsm", *solve, "--trace", "o3.vsm"),
                    ("solve", "torus.vsm", "o3.vsm", *solve, "--trace", name)):
        assert "choose another name" in run(*command, code=1).stderr
    for file, content in before.items():
        assert open(file, "rb").read() == content, file
    assert not os.path.exists("o3.vsm") and os.path.islink("link.vsm")


def test_stages_are_explained():
    """All stages of both kinds of passes, and windows that are smaller than the levels."""
    name = problem(dirichlet=[{"halfspace": [1, 0, 0, 2], "value": [1]}], source=[1])
    for threads in (1, 4):
        done = run("solve", "torus.vsm", "explained.vsm", "--problem", name, "--threads", threads,
                   "--explain", "--report", "explained-report.json")
        report = load("explained-report.json")
        names = {(stage["first"], stage["name"]) for stage in report["stages"]}
        first = {"assemble rows", "coarsen"} if threads == 1 else {
            "weigh cells", "connect edges", "close rows", "choose C-points, P0", "relax P", "A P", "P^T A P",
            "sparsify, finish rows", "pack rows"}
        first |= {"relax before restriction", "restrict the residual"}
        assert {(True, name) for name in first} <= names, names
        assert {name for is_first, name in names if not is_first} == {
            "prolong the correction", "relax after prolongation", "relax before restriction", "combine iterates",
            "restrict the residual"}, names
        assert all(stage["seconds"] >= 0 for stage in report["stages"])
        finest = report["levels"][0]
        assert 0 < finest["window"] <= finest["nodes"], finest
        for text in ("P^T A P" if threads == 4 else "coarsen", "restrict the residual", "in memory"):
            assert text in done.stdout, done.stdout


def test_passes_are_traced():
    """The trace is a table whose stages end with the level; nothing of it is left where it fails."""
    name = problem(dirichlet=[{"halfspace": [1, 0, 0, 2], "value": [1]}], source=[1])
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": {"vertices": [0]}, "fixed": True}]}, file)
    for command, *task in (("solve", "--problem", name), ("deform", "--handles", "handles.json")):
        run(command, "torus.vsm", "traced.vsm", *task, "--trace", "trace.csv", "--report", "traced.json")
        report = load("traced.json")
        with open("trace.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        assert {int(row["pass"]) for row in rows} == set(range(1, report["passes"] + 1))
        for number in range(1, report["passes"] + 1):
            of = [row for row in rows if int(row["pass"]) == number and row["stage"] == "restrict the residual"
                  and row["level"] == "0"]
            assert sum(int(row["end"]) - int(row["first"]) for row in of) == 7200, (command, number)
        os.remove("trace.csv")
        for option in (("--trace", "trace.csv"), ("--explain",)):
            run(command, "torus.vsm", "traced.vsm", *task, *option, "--dry-run", code=2)
        run(command, "torus.vsm", "traced.vsm", *task, "--explain", "--quiet", code=2)
        run(command, "torus.vsm", "traced.vsm", *task, "--trace", "trace.csv", "--memory", "1", code=1)
        assert not [file for file in os.listdir(".") if file.startswith("trace.csv")], os.listdir(".")
    assert "no/trace.csv" in run("solve", "torus.vsm", "traced.vsm", "--problem", name,
                                 "--trace", "no/trace.csv", code=1).stderr


def test_reports_go_where_they_are_wanted():
    assert json.loads(run("info", "torus.vsm", "--report", "/dev/stdout", "--quiet").stdout)
    link("there.json", "here.json")
    run("info", "torus.vsm", "--report", "here.json", "--quiet")
    assert os.path.islink("here.json") and load("there.json")["vertices"] == 7200


def test_outputs_go_where_links_lead():
    name = problem(dirichlet=[{"sphere": [0, 0, 0, 9], "value": [0]}])
    with open("handles.json", "w", encoding="utf-8") as file:
        json.dump({"handles": [{"region": {"vertices": [0]}, "fixed": True}]}, file)
    os.makedirs("there", exist_ok=True)
    for command in (("convert", "torus.obj", "here.vsm"), ("convert", "torus.obj", "here.smb"),
                    ("convert", "torus.vsm", "here.obj", "--restore-order"),
                    ("preview", "torus.vsm", "here.vtp"),
                    ("solve", "torus.vsm", "here.ply", "--problem", name),
                    ("deform", "torus.vsm", "here.vtu", "--handles", "handles.json")):
        out = command[2]
        target = os.path.join("there", out)
        if os.path.exists(target):
            os.remove(target)
        link(target, out)
        run(*command, "--quiet")
        assert os.path.islink(out) and not os.path.islink(target), command
        assert os.path.getsize(target) > 1000, command
    link(os.path.join("nowhere", "o.vsm"), "here.vsm")
    assert "no folder nowhere" in run("convert", "torus.obj", "here.vsm", code=1).stderr


def test_devices_and_pipes_are_no_outputs():
    if os.path.exists("pipe.vsm"):
        os.remove("pipe.vsm")
    os.mkfifo("pipe.vsm")
    link("pipe.vsm", "to-pipe.vsm")
    name = problem(dirichlet=[{"sphere": [0, 0, 0, 9], "value": [0]}])
    for out in ("pipe.vsm", "to-pipe.vsm"):
        for command in (("convert", "torus.obj", out), ("solve", "torus.vsm", out, "--problem", name)):
            assert f"{out}: this is a device or a pipe" in run(*command, code=1).stderr, command
    assert stat.S_ISFIFO(os.stat("pipe.vsm").st_mode)


def test_check():
    """Every block of a file is checked, and damage is located."""
    assert "checksums" not in run("info", "torus.vsm").stdout
    done = run("info", "torus.vsm", "--check", "--report", "info.json")
    blocks = load("info.json")["checked_blocks"]
    assert "those of all %d blocks are right" % blocks in done.stdout and blocks > 3, done.stdout
    with open("torus.vsm", "rb") as file:
        data = bytearray(file.read())
    damaged = set()
    for at in range(17000, len(data) - 2000, len(data) // 20):
        wrong = data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]
        with open("damaged.vsm", "wb") as file:
            file.write(wrong)
        error = run("info", "damaged.vsm", "--check", code=1).stderr
        assert "damaged.vsm: table '" in error and "', block " in error, error
        damaged.add(error)
    assert len(damaged) > 3, damaged
    run("info", "damaged.vsm")
    assert "only .vsm files" in run("info", "torus.obj", "--check", code=1).stderr


def test_what_cannot_be_said_is_an_error():
    name = problem(dirichlet=[{"sphere": [0, 0, 0, 9], "value": [0]}])
    for command in (("info", "torus.vsm"), ("convert", "torus.obj", "o4.vsm"), ("solve", "--help"),
                    ("solve", "torus.vsm", "o4.vsm", "--problem", name), ("--version",),
                    ("preview", "torus.vsm", "o4.vtp")):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([SMG, *command], stdout=full, stderr=subprocess.PIPE, text=True,
                                  check=False)
        assert done.returncode == 1 and "standard output" in done.stderr, (command, done)
    error = run("info", "torus.vsm", "--report", "/dev/full", code=1).stderr
    assert "/dev/full" in error and "space" in error, error
    # The result is complete by then.
    run("convert", "torus.obj", "o4.vsm", "--report", "/dev/full", code=1)
    run("info", "o4.vsm", "--check")


def test_interrupt_cleans_up():
    os.makedirs("scratch", exist_ok=True)
    write_torus("large.obj", 900, 500)
    before = sorted(os.listdir("."))
    for kind, delay in ((signal.SIGINT, 0.1), (signal.SIGTERM, 0.3), (signal.SIGTERM, 0.6),
                        (signal.SIGHUP, 0.3)):
        process = subprocess.Popen(
            [SMG, "convert", "large.obj", "large.smb", "--scratch", "scratch"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(delay)
        process.send_signal(kind)
        _, error = process.communicate(timeout=600)
        if process.returncode == 0:
            # It ended before the signal.
            os.remove("large.smb")
        else:
            # The second: before the program has begun to catch signals.
            assert process.returncode in (128 + kind, -kind), process.returncode
            assert process.returncode < 0 or error == "smg: cancelled\n", error
        assert sorted(os.listdir(".")) == before and os.listdir("scratch") == []


for each in (test_convert_and_info, test_the_commands_are_listed, test_vtk_xml, test_solve,
             test_solutions_have_the_order_of_their_mesh, test_errors,
             test_files_of_the_command_are_not_overwritten, test_stages_are_explained, test_passes_are_traced,
             test_reports_go_where_they_are_wanted,
             test_outputs_go_where_links_lead, test_devices_and_pipes_are_no_outputs, test_check,
             test_what_cannot_be_said_is_an_error, test_interrupt_cleans_up):
    each()
    print("passed", each.__name__)
sys.exit(0)
