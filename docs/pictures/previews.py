#!/usr/bin/env pvpython
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a mesh beside its previews of 100,000 and 10,000 points.

xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython previews.py SMG MESH OUT.png [AZIMUTH ELEVATION]"""

import os
import subprocess
import sys
import tempfile

from paraview.simple import *
from PIL import Image

smg, mesh, out = sys.argv[1:4]
azimuth, elevation = (float(angle) for angle in sys.argv[4:] or (30, 10))
folder = tempfile.mkdtemp()
pictures = [os.path.join(folder, "mesh.vtp")]
subprocess.run([smg, "convert", mesh, pictures[0], "--quiet"], check=True)
for points in (100000, 10000):
    pictures.append(os.path.join(folder, "%d.vtp" % points))
    subprocess.run([smg, "preview", mesh, pictures[-1], "--points", str(points), "--quiet"], check=True)
shots = []
for place, picture in enumerate(pictures):
    view = CreateView("RenderView")
    view.ViewSize, view.Background, view.UseColorPaletteForBackground = [560, 640], [0.93, 0.94, 0.96], 0
    view.OrientationAxesVisibility = 0
    shown = Show(OpenDataFile(picture), view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor, shown.Specular, shown.Interpolation = [0.87, 0.85, 0.8], 0.2, "Flat"
    ResetCamera(view)
    camera = GetActiveCamera()
    camera.Elevation(-90 + elevation)
    camera.SetViewUp(0, 0, 1)
    camera.Azimuth(azimuth)
    camera.Zoom(1.4)
    Render(view)
    shots.append(os.path.join(folder, "%d.png" % place))
    SaveScreenshot(shots[-1], view, ImageResolution=[560, 640])
images = [Image.open(shot) for shot in shots]
whole = Image.new("RGB", (sum(image.width for image in images), images[0].height))
for place, image in enumerate(images):
    whole.paste(image, (place * images[0].width, 0))
whole.save(out)
