#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg solve --engine hypre on several processes: results, pieces, reports and errors."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

from mesh_files import read_mesh
from program import PROGRESS, SANITIZED, SMG, load, read_vtk_xml, run, write_medit, write_torus
from small_disk import SmallDisk, can_mount
from tetrahedra import tetrahedra

MPIEXEC = shutil.which("mpiexec")
# As in cmake/SmgTesting.cmake.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                  OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")
PROBLEM = {"source": [1], "dirichlet": [{"halfspace": [-1, 0, 0, 0], "value": [2]}],
           "robin": [{"boundary": True, "coefficient": 0.5, "ambient": [1]}]}


def run_on(processes, *arguments, code=0):
    """Runs smg on several processes; an error must be one line of smg."""
    done = subprocess.run([MPIEXEC, "-n", str(processes), SMG, *map(str, arguments), "--no-sync"],
                          capture_output=True, text=True, timeout=2500)
    assert (done.returncode != 0) == (code != 0), (arguments, done.stdout, done.stderr)
    said = re.sub(PROGRESS, "", done.stderr).splitlines()
    lines = [line for line in said if re.match("smg: (?!warning: )", line)]
    assert len(lines) == (1 if code else 0), done.stderr
    return lines[0] if code else done


def write_problem(name, problem):
    with open(name, "w", encoding="utf-8") as file:
        json.dump(problem, file)


def solution_of(name):
    """The solution by original number."""
    arrays = read_vtk_xml(name)
    return {number: value for (number,), value in zip(arrays["OriginalId"], arrays["Solution"])}


def assert_equal(values, expected, name):
    scale = max(v for row in expected.values() for v in row) - min(
        v for row in expected.values() for v in row)
    assert values.keys() == expected.keys(), name
    error = max(abs(a - b) for k in values for a, b in zip(values[k], expected[k]))
    assert error < 1e-6 * scale, (name, error)


def assert_same_cells(values, expected):
    """Cell results in the order of the stream."""
    assert len(values) == len(expected)
    scale = max(abs(v) for row in expected for v in row)
    assert max(abs(a - b) for x, y in zip(values, expected) for a, b in zip(x, y)) < 1e-6 * scale


def assert_same_results(report, figures):
    """The derived results agree within 1e-6 of what flows, or of their size."""
    flows = max(abs(flux) for condition in figures["conditions"] for flux in condition["flux"])
    assert len(report["conditions"]) == len(figures["conditions"]) > 0
    for a, b in zip(report["conditions"], figures["conditions"]):
        assert (a["name"], a["vertices"]) == (b["name"], b["vertices"])
        assert abs(a["area"] - b["area"]) <= 1e-6 * b["area"], (a, b)
        assert abs(a["mean"][0] - b["mean"][0]) <= 1e-6 * abs(b["mean"][0]), (a, b)
        assert abs(a["flux"][0] - b["flux"][0]) <= 1e-6 * flows, (a, b)
    for key in "energy", "mean", "source", "screening":
        assert abs(report[key][0] - figures[key][0]) <= 1e-6 * abs(figures[key][0]), key
    assert abs(report["balance"][0]) < 1e-6
    for key in "minimum", "maximum":
        (a,), (b,) = report[key], figures[key]
        assert abs(a["value"] - b["value"]) <= 1e-6 * abs(b["value"]), key


def assert_final_in_last_piece(pieces):
    last = {number: p for p, piece in enumerate(pieces) for (number,) in piece["OriginalId"]}
    for p, piece in enumerate(pieces):
        for (number,), (final,) in zip(piece["OriginalId"], piece["StreamFinalized"]):
            assert final == (1 if last[number] == p else 0), (p, number)


def meshes():
    write_torus("torus.obj", 40, 20)
    points, cells = tetrahedra(6)
    write_medit("solid.mesh", points, cells)
    run("convert", "torus.obj", "torus.vsm", "--quiet")
    run("convert", "solid.mesh", "solid.vsm", "--quiet")
    outputs = ["gradient", "flux"]
    surface = {key: PROBLEM[key] for key in ("source", "dirichlet")}
    write_problem("torus.json", dict(surface, outputs=outputs, screening=0.2))
    write_problem("solid.json", dict(PROBLEM, outputs=outputs, conductivity=[3, 2, 1, 0.5, 0, 0],
                                     flux=[{"halfspace": [1, 0, 0, 0.99], "value": 3}]))
    return ("torus", ".vtp", ".pvtp"), ("solid", ".vtu", ".pvtu")


def test_any_number_of_processes_gives_the_same():
    for name, suffix, index in meshes():
        options = ("--problem", name + ".json", "--tolerance", "1e-10", "--report", "report.json")
        run("solve", name + ".vsm", "expected" + suffix, *options)
        expected = solution_of("expected" + suffix)
        figures = load("report.json")
        cells = read_vtk_xml("expected" + suffix)
        for processes in (1, 2, 3):
            run_on(processes, "solve", name + ".vsm", "out" + suffix, *options, "--engine", "hypre")
            assert_equal(solution_of("out" + suffix), expected, (name, processes))
            report = load("report.json")
            assert report["converged"] and report["distributed"]["processes"] == processes
            assert len(report["distributed"]["rss_bytes_peak"]) == processes
            assert len(report["residuals"]) == report["cycles"]
            for key in ("vertices", "cells", "prescribed", "components"):
                assert report[key] == figures[key], key
            assert_same_results(report, figures)
            run_on(processes, "solve", name + ".vsm", "pieces" + index, *options, "--engine", "hypre")
            assert_same_results(load("report.json"), figures)
            pieces = [read_vtk_xml(f"pieces/pieces_{p}{suffix}") for p in range(processes)]
            for result in "Gradient", "Flux":
                assert_same_cells(sum((piece[result] for piece in pieces), []), cells[result])
            values = {number: value for piece in pieces for (number,), (ghost,), value in zip(
                piece["OriginalId"], piece["vtkGhostType"], piece["Solution"]) if ghost == 0}
            assert_equal(values, expected, (name, processes))
            assert_final_in_last_piece(pieces)
            run("convert", "pieces" + index, "again.vsm", "--quiet")
            run("info", "again.vsm", "--report", "info.json")
            assert load("info.json")["vertices"] == figures["vertices"]
            assert load("info.json")["cells"] == figures["cells"]


def test_failures_are_one_line():
    arguments = ("--problem", "solid.json", "--engine", "hypre")
    assert "none.vsm" in run_on(2, "solve", "none.vsm", "failed.vtu", *arguments, code=1)
    assert "convert the mesh first" in run_on(2, "solve", "solid.mesh", "failed.vtu", *arguments, code=1)
    write_problem("bad.json", {"dirichlet": [{"sphere": [90, 0, 0, 1], "value": [1]}]})
    assert "no vertex" in run_on(
        3, "solve", "solid.vsm", "failed.vtu", "--problem", "bad.json", "--engine", "hypre", code=1)
    for option in ("--in-core", "--dry-run"):
        assert "leave them out" in run_on(2, "solve", "solid.vsm", "failed.vtu", *arguments, option, code=1)
    write_torus("wide.obj", 120, 60)
    run("convert", "wide.obj", "wide.vsm", "--quiet")
    assert "more than the memory limit" in run_on(3, "solve", "wide.vsm", "failed.vtp", "--problem",
                                                  "torus.json", "--engine", "hypre", "--memory", "1", code=1)
    assert "folder" in run_on(2, "solve", "solid.vsm", "none/failed.vtu", *arguments, code=1)
    with open("solid.vsm", "rb") as file:
        content = bytearray(file.read())
    for k in range(len(content) // 3, len(content) // 3 + 64):
        content[k] ^= 0xFF
    with open("damaged.vsm", "wb") as file:
        file.write(content)
    assert "damaged.vsm" in run_on(3, "solve", "damaged.vsm", "failed.vtu", *arguments, code=1)
    assert not os.path.exists("failed.vtu") and not os.path.exists("failed.pvtu")


def run_pair(first, second):
    """Runs smg with other arguments in each of two processes, which fail; returns the line."""
    with_options = [[SMG, *map(str, arguments), "--no-sync"] for arguments in (first, second)]
    done = subprocess.run([MPIEXEC, "-n", "1", *with_options[0], ":", "-n", "1", *with_options[1]],
                          capture_output=True, text=True, timeout=2500)
    lines = [line for line in done.stderr.splitlines() if line.startswith("smg: ")]
    assert done.returncode != 0 and len(lines) == 1, done
    return lines[0]


def test_processes_that_are_asked_differently_are_refused():
    write_problem("other.json", {"dirichlet": [{"halfspace": [1, 0, 0, 0], "value": [2]}]})
    write_problem("one.json", {"dirichlet": [{"halfspace": [1, 0, 0, 0], "value": [1]}]})

    def arguments(*options, mesh="solid.vsm", problem="one.json"):
        return ("solve", mesh, "differs.pvtu", "--problem", problem, "--engine", "hypre", *options)

    assert "same text" in run_pair(arguments(), arguments(problem="other.json"))
    assert "same tolerance" in run_pair(arguments(), arguments("--tolerance", "1e-2"))
    write_torus("ring.obj", 30, 15)
    run("convert", "ring.obj", "ring.vsm", "--quiet")
    write_torus("ring.obj", 30, 16)
    run("convert", "ring.obj", "ring2.vsm", "--quiet")
    assert "same mesh" in run_pair(arguments(mesh="ring.vsm"), arguments(mesh="ring2.vsm"))
    assert not os.path.exists("differs.pvtu") and not os.path.exists("differs")


def test_processes_do_not_do_the_same():
    done = subprocess.run([MPIEXEC, "-n", "2", SMG, "solve", "solid.vsm", "same.vtu", "--problem", "solid.json"],
                          capture_output=True, text=True, timeout=2500)
    assert done.returncode != 0 and "start smg once" in done.stderr, done
    assert not os.path.exists("same.vtu")


def hypre(name, out):
    return ("solve", name + ".vsm", out, "--problem", name + ".json", "--engine", "hypre")


def test_pieces_hold_the_cells():
    error = run_on(2, *hypre("solid", "x.pvtp"), code=1)
    assert "x.pvtp: a .pvtp file holds no tetrahedra: choose .pvtu" in error, error
    assert not os.path.exists("x.pvtp") and not os.path.exists("x")
    run_on(2, *hypre("torus", "grid.pvtu"))  # triangles of a grid
    run("convert", "grid.pvtu", "again.vsm", "--quiet")


def test_a_result_is_the_pieces_of_one_run():
    run_on(3, *hypre("torus", "again.pvtp"))
    for name in "again/again_7.vtp", "again/again_note.vtp", "again/again_2.vtu":
        with open(name, "w", encoding="utf-8"):
            pass
    run_on(2, *hypre("torus", "again.pvtp"))
    # Other files remain.
    assert sorted(os.listdir("again")) == ["again_0.vtp", "again_1.vtp", "again_2.vtu", "again_note.vtp"]
    # A piece that cannot be written is the end of the earlier result.
    os.remove("again/again_1.vtp")
    os.mkdir("again/again_1.vtp")
    assert "again_1.vtp" in run_on(2, *hypre("torus", "again.pvtp"), code=1)
    assert not os.path.exists("again.pvtp") and not os.path.exists("again/again_0.vtp")


def test_where_no_piece_can_be_is_said_before():
    with open("taken", "w", encoding="utf-8"):
        pass
    error = run_on(2, *hypre("torus", "taken.pvtp"), code=1)
    assert "taken.pvtp: its pieces go into the folder taken, but that is a file" in error, error
    if not can_mount():
        return
    with SmallDisk("small", 64 << 10) as folder:
        error = run_on(2, *hypre("torus", folder + "/full.pvtp"), code=1)
        assert "full.pvtp" in error and "full/full_" not in error, error
        assert os.listdir(folder) == []


def test_only_this_engine_loads_mpi():
    libraries = subprocess.run(["ldd", SMG], capture_output=True, text=True, check=True).stdout
    assert "libmpi" not in libraries and "HYPRE" not in libraries


def run_where_possible(refused, tests):
    """Runs the tests where this build and this machine have the engine; elsewhere the command with
    the arguments `refused` says that the build has not."""
    if os.environ.get("SMG_HAS_HYPRE") != "1":
        done = run(*refused(), "--engine", "hypre", code=1)
        assert "was built without MPI and hypre" in done.stderr
    elif not MPIEXEC:
        print("SKIPPED: mpiexec is not installed")
        sys.exit(77)
    elif SANITIZED:
        print("SKIPPED: MPI and hypre do not free everything")
        sys.exit(77)
    else:
        for test in tests:
            test()


def refused():
    meshes()
    return "solve", "solid.vsm", "x.vtu", "--problem", "solid.json"


if __name__ == "__main__":
    test_only_this_engine_loads_mpi()
    with tempfile.TemporaryDirectory(dir=".") as empty:
        os.chdir(empty)  # the tests look for files that are not to be there
        run_where_possible(refused, [
            test_any_number_of_processes_gives_the_same, test_failures_are_one_line,
            test_pieces_hold_the_cells, test_a_result_is_the_pieces_of_one_run,
            test_where_no_piece_can_be_is_said_before,
            test_processes_that_are_asked_differently_are_refused, test_processes_do_not_do_the_same])
        os.chdir("..")
