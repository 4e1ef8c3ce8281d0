#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""smg --report FILE.html as a black box: pages are well formed, need nothing but themselves, and say
what the report in JSON says."""

import json
import os

from html_pages import page_of, write_json, write_scan
from program import load, run

HANDLES = [{"region": {"halfspace": [-1, 0, 0, 2.5]}, "fixed": True},
           {"region": {"halfspace": [1, 0, 0, 2.5]}, "translate": [0, 0, 1]}]
JOBS = {
    "solve": ("scan.ply", "out.vtp", "--problem", "problem.json"),
    "deform": ("scan.vsm", "out.obj", "--handles", "handles.json"),
    "smooth": ("scan.ply", "out.ply", "--steps", 2),
    "blend": ("scan.ply", "out.ply", "--patch", "scan", "--columns", "Colors"),
    "distance": ("scan.vsm", "out.vsm", "--from", '{"nearest": [[3, 0, 0]]}'),
}
# Entries that differ from run to run.
VARYING = {"seconds", "by_pass", "stages", "cpu_seconds", "rss_bytes_peak", "pool_bytes_peak", "scratch_bytes_peak",
           "threads"}


def write_files():
    write_scan("scan.ply")
    run("convert", "scan.ply", "scan.vsm", "--quiet")
    write_json("problem.json", dirichlet=[{"mask": "mask", "value": [1]},
                                          {"halfspace": [-1, 0, 0, 2.9], "value": [-0.5]}])
    write_json("handles.json", handles=HANDLES)


def test_pages_say_what_reports_say():
    for command, arguments in JOBS.items():
        page = page_of(command, *arguments)
        run(command, *arguments, "--report", "report.json", "--quiet")
        report, other = page.report(), load("report.json")
        assert report.keys() == other.keys(), command
        for name in report.keys() - VARYING:
            assert report[name] == other[name], (command, name)
        assert command in page.text and arguments[0] in page.text
        assert "✓ Converged" in page.text and "Not converged" not in page.text
        assert "vertices {:,}".format(report["vertices"]) in page.text, command
        assert "cells {:,}".format(report["cells"]) in page.text, command
        if report["residuals"]:
            digits = "%.3g" % report["residuals"][-1]
            assert digits.replace("e-0", "e-") in page.text, (command, digits)
            assert page.tags.count("circle") == len(report["residuals"]), command
            assert ("tolerance 1e-6" if command == "deform" else "tolerance 1e-8") in page.text
        for level in report["levels"]:
            assert "{:,}".format(level["nonzeros"]) in page.text, command
        for name in ("memory", "time", "figures"):
            assert page.ids[name], (command, name)
        for note in report["notes"]:
            assert note in page.text, (command, note)


def test_surfaces():
    page = page_of("solve", *JOBS["solve"])
    points, _, columns = page.surface()
    report = page.report()
    # A mesh of few points is drawn as it is; positions are relative to the centre.
    assert len(points) == 3 * report["vertices"] == 3 * 7200
    assert abs(max(points) - 3) < 1e-6 and abs(min(points) + 3) < 1e-6
    solution = columns["Solution"]
    assert (solution["least"], solution["most"]) == (report["minimum"][0]["value"], report["maximum"][0]["value"])
    assert min(solution["values"]) == 0 and max(solution["values"]) == 65534
    assert list(columns) == ["Solution", "Colors", "scan", "mask"] and columns["Colors"]["isColour"]
    # A file that cannot hold the columns of the mesh loses none on the page; the moved surface is drawn.
    page = page_of("deform", *JOBS["deform"])
    points, _, columns = page.surface()
    assert "Colors" in columns and "OriginalId" not in columns
    assert abs(max(points[2::3]) - min(points[2::3]) - 3) < 0.2
    # Distances that are infinite have no colour.
    with open("two.obj", "w", encoding="utf-8") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n")
    columns = page_of("distance", "two.obj", "two.vsm", "--from", '{"vertices": [0]}').surface()[2]
    assert columns["Distance"]["most"] == 1 and columns["Distance"]["values"].count(65535) == 3
    # Larger ones are simplified.
    write_scan("large.ply", nu=300, nv=120)
    page = page_of("smooth", "large.ply", "large.vsm", "--memory", 64)
    assert 15000 < len(page.surface()[0]) / 3 <= 20000 and "simplified from 36,000 vertices" in page.text


def test_hostile_names():
    mask, name = "</script><b>", "<b>&\"' \u00e9\u4e16.ply"
    write_scan(name, mask=mask)
    write_json("<i>.json", dirichlet=[{"mask": mask, "value": [1]}], screening=1)
    page = page_of("solve", name, "<u>.vsm", "--problem", "<i>.json")
    assert "b" not in page.tags and "i" not in page.tags and "u" not in page.tags
    assert "Solution on " + name in page.text and "'<u>.vsm'" in page.text
    assert json.loads(page.ids["task"])["dirichlet"][0]["mask"] == mask
    assert mask in page.surface()[2]
    # Bytes that are no text at all.
    broken = os.fsdecode(b"\xff\xfe<.vsm")
    os.rename("scan.vsm", broken)
    page = page_of("distance", broken, "out.vsm", "--from", '{"vertices": [0]}')
    os.rename(broken, "scan.vsm")
    assert "Distances on \ufffd\ufffd<.vsm" in page.text


def test_not_converged():
    arguments = (*JOBS["solve"], "--tolerance", "1e-14", "--max-cycles", 2)
    page = page_of("solve", *arguments, code=3)
    assert "✗ Not converged" in page.text and page.report()["converged"] is False
    assert "tolerance 1e-14" in page.text and page.surface()
    # Without an iteration there is no figure of residuals.
    write_json("initial.json", dirichlet=[{"value": [1]}])
    page = page_of("solve", "scan.vsm", "out.vsm", "--problem", "initial.json")
    assert "no V-cycle was needed" in page.text and page.report()["residuals"] == []


def test_other_commands():
    page = page_of("convert", "scan.ply", "again.vsm", "--order", "spectral")
    assert "Conversion of scan.ply" in page.text and "Colors" in page.surface()[2]
    assert "surface" not in page_of("convert", "scan.ply", "again.ply").ids
    page = page_of("info", "scan.ply")
    assert "uint8" in page.text and page.surface() and page.report()["columns"]["vertices"]
    page = page_of("simplify", "scan.vsm", "small.stl", "--vertices", 500)
    assert "vertices 500 of 7,200" in page.text and len(page.surface()[0]) == 3 * 500
    page = page_of("preview", "scan.vsm", "small.vtp", "--points", 400)
    assert "points {:,}".format(page.report()["points"]) in page.text and page.surface()
    for command, arguments in JOBS.items():
        page = page_of(command, *arguments, "--dry-run")
        assert "Expected costs: " + command in page.text and "surface" not in page.ids
        assert page.report()["vertices"] > 0 and page.ids["estimate"]


def test_failures():
    def fails(*arguments, code=1):
        return run("solve", "scan.vsm", "out.vsm", "--problem", "problem.json", *arguments, code=code).stderr

    os.makedirs("folder.html", exist_ok=True)
    assert "the report cannot be written" in fails("--report", "folder.html")
    assert "cannot be created" in fails("--report", "nowhere/page.html")
    os.replace("scan.vsm", "scan.html")
    done = run("info", "scan.html", "--report", "scan.html", code=1)
    os.replace("scan.html", "scan.vsm")
    assert "would overwrite it" in done.stderr
    # A command that fails leaves the page of an earlier one as it is, and nothing beside it.
    before = page_of("info", "scan.vsm").source
    fails("--report", "page.html", "--scratch-limit", "1", "--memory", "1", code=1)
    with open("page.html", encoding="utf-8") as file:
        assert file.read() == before
    assert not [name for name in os.listdir(".") if ".part" in name]


write_files()
test_pages_say_what_reports_say()
test_surfaces()
test_hostile_names()
test_not_converged()
test_other_commands()
test_failures()
print("passed")
