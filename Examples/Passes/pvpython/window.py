# SPDX-License-Identifier: BSD-3-Clause
"""The window of a solve, drawn over the Stanford bunny, with pvpython.

A solve reads the mesh as a stream. What is in memory at a moment, on the finest level and on the
coarse ones, is a window that moves over the mesh: once in the first pass, in which the hierarchy
appears in it, and once in each later pass.

What this lesson shows:
 1. `smg solve --trace FILE` writes which nodes each stage passes in each step, and which ones each
    level has in memory: a table.
 2. The nodes of a coarse level are those of the finer one that are C-points, in their order. The
    program `hierarchy`, a lesson beside this one, writes which.
 3. The picture has three moments of the first pass: vertices in memory are orange, those that all
    stages have passed blue, those that have not been read grey. Spheres are the nodes of the coarse
    levels in memory, larger ones those of coarser levels. The film has all steps of two passes.

Run it under a display, or under xvfb-run:

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython window.py --output .

    34834 vertices, 4 levels in the passes
    bunny-window.png
    bunny-window.gif

So small a mesh would keep its coarse levels in memory: hidden options of `smg` stream them, and make
the steps short.
"""

import argparse
import csv
import glob
import json
import os
import subprocess
import sys

import numpy as np
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkSphereSource

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.path.join(HERE, "..", "..", "..", "build")
WAITING, OPEN, PASSED = 0, 1, 2
COLOURS = {WAITING: (0.82, 0.82, 0.82), OPEN: (0.95, 0.6, 0.25), PASSED: (0.5, 0.62, 0.78)}
LEVELS = [(0.75, 0.1, 0.1), (0.15, 0.45, 0.15), (0.2, 0.1, 0.5), (0.0, 0.0, 0.0)]
SIZE = 400  # pixels of a picture


def parse_arguments():
    plugins = glob.glob(os.path.join(BUILD, "lib", "*", "plugins", "*", "StreamingMultigrid.so"))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plugin", default=plugins[0] if plugins else None,
                        help="StreamingMultigrid.so; default: that of the tree's build folder, if any")
    parser.add_argument("--programs", default=os.path.join(BUILD, "bin"),
                        help="folder of smg and hierarchy")
    parser.add_argument("--mesh", default=os.path.join(HERE, "..", "..", "Data", "bunny.smb"))
    parser.add_argument("--output", default=".", help="folder for the pictures")
    parser.add_argument("--every", type=int, default=3, help="steps of the film from picture to picture")
    return parser.parse_args()


def solve(programs, mesh, output):
    """Solves for the field of the first lesson; returns the files of the stream, the trace and the
    hierarchy."""
    stream, trace, hierarchy, problem = (
        os.path.join(output, name) for name in
        ("bunny.vsm", "bunny-trace.csv", "bunny-hierarchy.csv", "bunny-problem.json"))
    with open(problem, "w") as file:
        json.dump({"dirichlet": [
            {"halfspace": [0, -1, 0, -0.036], "value": 0},
            {"halfspace": [0, 1, 0, 0.18], "value": 1}]}, file)
    smg = os.path.join(programs, "smg")
    for command in (
            [smg, "convert", mesh, stream, "--quiet"],
            [smg, "solve", stream, os.path.join(output, "bunny-solved.vsm"), "--problem", problem,
             "--trace", trace, "--threads", "1", "--core-nodes", "500", "--block-nodes", "512", "--quiet"],
            [os.path.join(programs, "hierarchy"), stream, hierarchy]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return stream, trace, hierarchy


def vertices_of_levels(file):
    """For each level, the vertices of the mesh that its nodes are."""
    points = {}
    with open(file) as table:
        for row in csv.DictReader(table):
            if row["relation"] == "C-point":
                points.setdefault(int(row["level"]), []).append((int(row["other"]), int(row["node"])))
    vertices, levels = None, []
    for level in sorted(points):
        nodes = np.array([node for _, node in sorted(points[level])])
        vertices = nodes if vertices is None else vertices[nodes]
        levels.append(vertices)
    return levels


def windows_of(file):
    """After each step of each pass: {level: (first, end)} of the nodes in memory."""
    steps, now = {}, {}
    with open(file) as table:
        for row in csv.DictReader(table):
            at = int(row["pass"]), int(row["step"])
            if at[1] == 1 and at not in steps:
                now = {}
            if row["stage"] == "in memory":
                now[int(row["level"])] = int(row["first"]), int(row["end"])
            steps[at] = dict(now)
    return steps


class Picture:
    """The mesh and the coarse nodes in memory, for any step."""

    def __init__(self, reader, levels):
        reader.UpdatePipeline()
        self.mesh = reader.GetClientSideObject().GetOutputDataObject(0)
        self.points = vtk_to_numpy(self.mesh.GetPoints().GetData())
        self.levels = levels
        self.view = None
        self.size = np.ptp(self.points, axis=0).max() / 2

    def surface(self, window):
        first, end = window.get(0, (0, 0))
        state = np.full(len(self.points), WAITING)
        state[:end] = OPEN
        state[:first] = PASSED
        mesh = self.mesh.NewInstance()
        mesh.ShallowCopy(self.mesh)
        colours = numpy_to_vtk(
            (255 * np.array([COLOURS[k] for k in range(3)]))[state].astype(np.uint8), deep=True)
        colours.SetName("Colour")
        mesh.GetPointData().AddArray(colours)
        return mesh

    def nodes(self, window, level):
        first, end = window.get(level, (0, 0))
        points = vtkPoints()
        points.SetData(numpy_to_vtk(self.points[self.levels[level - 1][first:end]], deep=True))
        data = vtkPolyData()
        data.SetPoints(points)
        ball = vtkSphereSource()
        ball.SetRadius((0.6 + 0.5 * level) * 1e-2 * self.size)
        ball.SetThetaResolution(8)
        ball.SetPhiResolution(6)
        balls = vtkGlyph3D()
        balls.SetInputData(data)
        balls.SetSourceConnection(ball.GetOutputPort())
        balls.SetScaleModeToDataScalingOff()
        balls.Update()
        return balls.GetOutput()

    def draw(self, view, window):
        shown = Show(self.producer(self.surface(window)), view)
        ColorBy(shown, ("POINTS", "Colour"))
        shown.MapScalars = 0
        shown.Ambient, shown.Diffuse, shown.Specular = 0.35, 0.65, 0.0
        for level in range(1, len(self.levels) + 1):
            nodes = self.nodes(window, level)
            if nodes.GetNumberOfPoints():
                shown = Show(self.producer(nodes), view)
                colour = LEVELS[min(level, len(LEVELS)) - 1]
                shown.AmbientColor = shown.DiffuseColor = colour
                shown.ColorArrayName = ["POINTS", ""]

    @staticmethod
    def producer(data):
        producer = TrivialProducer()
        producer.GetClientSideObject().SetOutput(data)
        return producer

    def shoot(self, window, file):
        isFirst = self.view is None
        if isFirst:
            self.view = CreateView("RenderView")  # one for all pictures: each has threads of its own
            self.view.ViewSize, self.view.Background = [SIZE, SIZE], [1, 1, 1]
            self.view.UseColorPaletteForBackground = self.view.OrientationAxesVisibility = 0
        self.draw(self.view, window)
        if isFirst:
            ResetCamera(self.view)
            camera = GetActiveCamera()
            camera.Azimuth(20)
            camera.Elevation(10)
            camera.Zoom(1.35)
        Render(self.view)
        SaveScreenshot(file, self.view, ImageResolution=[SIZE, SIZE])
        for source in list(GetSources().values()):
            if source.GetXMLName() == "TrivialProducer":
                Delete(source)


def main():
    arguments = parse_arguments()
    if arguments.plugin is None:
        sys.exit("window.py: the plugin was not found: build it, or name it with --plugin")
    os.makedirs(arguments.output, exist_ok=True)
    stream, trace, hierarchy = solve(arguments.programs, arguments.mesh, arguments.output)
    windows = windows_of(trace)
    streamed = max(level for window in windows.values() for level in window)
    LoadPlugin(arguments.plugin, ns=globals())
    reader = StreamingMeshReader(FileName=stream, MaximumPointsInMemory=2**31 - 1)
    picture = Picture(reader, vertices_of_levels(hierarchy)[:streamed])
    print("%d vertices, %d levels in the passes" % (len(picture.points), streamed + 1))

    from PIL import Image
    first = [at for at in sorted(windows) if at[0] == 1]
    moments = [first[int(share * len(first))] for share in (0.25, 0.5, 0.75)]
    film = sorted(at for at in windows if at[0] <= 2)[::arguments.every]
    shots = {}
    for at in sorted({*moments, *film}):
        file = os.path.join(arguments.output, "step.png")
        picture.shoot(windows[at], file)
        with Image.open(file) as image:
            shots[at] = image.convert("RGB")
        os.remove(file)
    whole = Image.new("RGB", (3 * SIZE, SIZE))
    for k, at in enumerate(moments):
        whole.paste(shots[at], (k * SIZE, 0))
    name = os.path.join(arguments.output, "bunny-window.png")
    whole.save(name)
    print(os.path.basename(name))
    frames = [shots[at].quantize(48) for at in film]
    name = os.path.join(arguments.output, "bunny-window.gif")
    frames[0].save(name, save_all=True, append_images=frames[1:], duration=90, loop=0)
    print(os.path.basename(name))


main()
