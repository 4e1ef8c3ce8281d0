#!/usr/bin/env pvpython
# SPDX-License-Identifier: BSD-3-Clause
"""Draws meshes beside their previews of 100,000 and 10,000 points, a row each.

xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython previews.py SMG OUT.png MESH[,AZIMUTH,ELEVATION]..."""

import os
import subprocess
import sys
import tempfile

from paraview.simple import *
from PIL import Image

WIDTH, HEIGHT = 440, 400
smg, out = sys.argv[1:3]


def files_of(mesh):
    """The mesh and its previews as files that ParaView reads."""
    folder = tempfile.mkdtemp()
    whole = os.path.join(folder, "mesh.vtu")
    subprocess.run([smg, "convert", mesh, whole, "--quiet"], check=True)
    files = [whole]
    for points in (100000, 10000):
        files.append(os.path.join(folder, "%d.vtp" % points))
        subprocess.run([smg, "preview", mesh, files[-1], "--points", str(points), "--quiet"], check=True)
    return files


def shot(file, angles):
    view = CreateView("RenderView")
    view.ViewSize, view.Background, view.UseColorPaletteForBackground = [WIDTH, HEIGHT], [0.93, 0.94, 0.96], 0
    view.OrientationAxesVisibility = 0
    shown = Show(OpenDataFile(file), view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor, shown.Specular, shown.Interpolation = [0.87, 0.85, 0.8], 0.2, "Flat"
    ResetCamera(view)
    camera = GetActiveCamera()
    camera.Elevation(-90 + angles[1])
    camera.SetViewUp(0, 0, 1)
    camera.Azimuth(angles[0])
    camera.Zoom(1.4)
    Render(view)
    name = file + ".png"
    SaveScreenshot(name, view, ImageResolution=[WIDTH, HEIGHT])
    Delete(view)
    return Image.open(name)


rows = []
for argument in sys.argv[3:]:
    mesh, *given = argument.split(",")
    angles = [float(angle) for angle in given] or [30, 10]
    rows.append([shot(file, angles) for file in files_of(mesh)])
whole = Image.new("RGB", (3 * WIDTH, len(rows) * HEIGHT))
for row, images in enumerate(rows):
    for column, image in enumerate(images):
        whole.paste(image, (column * WIDTH, row * HEIGHT))
whole.save(out)
