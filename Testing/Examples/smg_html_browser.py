#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A page of smg --report FILE.html in a browser: its script draws the result. Skipped without Chromium."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

from html_pages import page_of, write_json, write_scan

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
if not CHROMIUM:
    print("SKIPPED: there is no chromium")
    sys.exit(77)


def shown(name, *options):
    """The elements of a page after its scripts have run; Chromium draws without a graphics card."""
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
             "--user-data-dir=" + profile, "--window-size=1120,900", "--virtual-time-budget=20000",
             *options, "--dump-dom", "file://" + os.path.abspath(name)],
            capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout


def drawn(dom):
    """The pixels that the result covers; None if nothing was drawn."""
    canvas, = re.findall("<canvas[^>]*>", dom)
    absent, = re.findall('<p class="absent"[^>]*>', dom)
    pixels = re.search('data-drawn="([0-9]+)"', canvas)
    assert ("hidden" in absent) == (pixels is not None) == ("hidden" not in canvas), (canvas, absent)
    return pixels and int(pixels.group(1))


write_scan("scan.ply")
write_json("problem.json", dirichlet=[{"mask": "mask", "value": [1]},
                                      {"halfspace": [-1, 0, 0, 2.9], "value": [-0.5]}])
page_of("solve", "scan.ply", "out.vsm", "--problem", "problem.json")
SOFTWARE = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
dom = shown("page.html", *SOFTWARE)
# A torus of radii 2 and 1, seen from the side, covers a part of a picture of more than 500,000 pixels.
assert 50000 < drawn(dom) < 500000, drawn(dom)
options = re.findall("<option value=\"[^\"]*\">([^<]*)</option>", dom)
assert options == ["none", "Solution", "Colors", "scan", "mask"], options
assert '<span class="least">-0.5</span>' in dom and '<span class="most">1</span>' in dom
assert drawn(shown("page.html", "--disable-gpu", "--disable-3d-apis")) is None
print("passed")
