# SPDX-License-Identifier: BSD-3-Clause
"""One problem with every kind of datum, asked in the real ParaView, in pvpython (by a problem file, and
by arrays, numbers and conditions) and by smg: the same bits.

    every_datum.py PLUGIN MESH FOLDER [--pictures FOLDER] [--timeout SECONDS]

MESH is the heat sink of the lesson; the environment variable SMG_PROGRAM names smg.
"""

import json
import os
import subprocess
import sys

from paraview_gui import PANEL, PROPERTIES, Session, read_arguments

# No vertex lies on the border of a region.
LOW, HIGH = 0.0011, 0.0051
CORNER = [0.0101, 0.0102, 0.0001]
PROBLEM = {
    "conductivity": [{"value": "K"}, {"tag": ["PhysicalTag", 2], "value": [200, 180, 190, 1, 2, 3]}],
    "screening": "s",
    "source": [{"value": "f"}, {"sphere": [*CORNER, 0.0101], "value": 4e5}],
    "field": "q",
    "initial": "start",
    "dirichlet": [{"mask": "held", "value": "given"}, {"nearest": [CORNER], "value": 30}],
    "flux": [{"halfspace": [0, 0, -1, -LOW], "value": 1e5}],
    "robin": [{"halfspace": [0, 0, 1, HIGH], "coefficient": 100, "ambient": 20}],
    "soft": [{"tag": ["PhysicalTag", 2], "weight": 1e4, "value": 25}],
    "outputs": ["gradient", "flux"],
}
# Every array that the problem names.
ARRAYS = """
import numpy as np
p = inputs[0].Points
corners = np.asarray(inputs[0].Cells).reshape(-1, 5)[:, 1:]
m = np.asarray(p)[corners].mean(axis=1)
one = np.ones(len(m))
output.PointData.append(1e4 * (1 + p[:, 0]), "s")
output.PointData.append(1e5 * p[:, 1], "f")
output.PointData.append(20 + 1e3 * p[:, 2], "start")
output.PointData.append(np.asarray(p[:, 2] > 0.0151, dtype=np.uint8), "held")
output.PointData.append(22 + 1e2 * p[:, 0], "given")
output.CellData.append(np.stack([25 * one, 20 + 1e3 * m[:, 0], 30 * one, one, 2 * one, -one], axis=1), "K")
output.CellData.append(np.stack([1e5 * m[:, 1], 1e3 * one, -1e5 * m[:, 2]], axis=1), "q")
"""


def make_mesh(simple, plain, path):
    grid = path[:-4] + ".vtu"
    subprocess.run([os.environ["SMG_PROGRAM"], "convert", plain, grid, "--quiet"], check=True)
    reader = simple.XMLUnstructuredGridReader(FileName=[grid])
    arrays = simple.ProgrammableFilter(Input=reader, Script=ARRAYS, CopyArrays=1)
    simple.SaveData(grid, arrays)
    subprocess.run([os.environ["SMG_PROGRAM"], "convert", grid, path, "--quiet"], check=True)


def by_arrays(simple, mesh):
    """The filter with all properties set except those of a problem file."""
    ends = simple.MeshCondition(Input=mesh, Region="Points", Condition="Dirichlet", Value=30)
    ends.Points = CORNER
    metal = simple.MeshCondition(Input=ends, Region="Tag", TagArray="PhysicalTag", Tag=2)
    metal.Condition, metal.Values = "Conductivity", [200, 180, 190, 1, 2, 3]
    warm = simple.MeshCondition(Input=metal, RegionFunction="Sphere", Condition="Source", Value=4e5)
    warm.RegionFunction.Center, warm.RegionFunction.Radius = CORNER, 0.0101
    heating = simple.MeshCondition(Input=warm, RegionFunction="Plane", Condition="Flux", Value=1e5)
    heating.RegionFunction.Origin, heating.RegionFunction.Normal = [0, 0, LOW], [0, 0, 1]
    air = simple.MeshCondition(Input=heating, RegionFunction="Plane", Condition="Robin", Value=20)
    air.RegionFunction.Origin, air.RegionFunction.Normal = [0, 0, HIGH], [0, 0, -1]
    air.Coefficient = 100
    soft = simple.MeshCondition(Input=air, Region="Tag", TagArray="PhysicalTag", Tag=2)
    soft.Condition, soft.Value, soft.Coefficient = "Soft", 25, 1e4
    return simple.StreamingPoisson(
        Input=soft, ConductivityArray=["CELLS", "K"], ScreeningArray=["POINTS", "s"],
        Source=["POINTS", "f"], FieldArray=["CELLS", "q"], InitialGuess=["POINTS", "start"],
        DirichletMask=["POINTS", "held"], DirichletValues=["POINTS", "given"], Gradient=1, Flux=1)


def results(simple, path):
    """The bytes of the results, by name."""
    from paraview import servermanager
    from paraview.vtk.util.numpy_support import vtk_to_numpy

    data = servermanager.Fetch(simple.StreamingMeshReader(FileName=path))
    named = lambda arrays, name: vtk_to_numpy(arrays.GetArray(name))
    solution = named(data.GetPointData(), "Solution")
    assert 20 < solution.min() < solution.max() < 100, (path, solution.min(), solution.max())
    return {"Solution": solution.tobytes(),
            "Gradient": named(data.GetCellData(), "Gradient").tobytes(),
            "Flux": named(data.GetCellData(), "Flux").tobytes()}


def play(arguments):
    from paraview import simple

    folder = os.path.abspath(arguments.folder)
    path = lambda name: os.path.join(folder, name)
    simple.LoadPlugin(arguments.plugin, ns=simple.__dict__)
    make_mesh(simple, arguments.mesh, path("mesh.vsm"))
    with open(path("problem.json"), "w", encoding="utf-8") as file:
        json.dump(PROBLEM, file)

    subprocess.run([os.environ["SMG_PROGRAM"], "solve", path("mesh.vsm"), path("smg.vsm"),
                    "--problem", path("problem.json"), "--quiet"], check=True)
    mesh = simple.StreamingMeshReader(FileName=path("mesh.vsm"))
    simple.SaveData(path("file.vsm"), simple.StreamingPoisson(Input=mesh, ProblemFileName=path("problem.json")))
    simple.SaveData(path("arrays.vsm"), by_arrays(simple, mesh))

    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.open(path("mesh.vsm"))
    session.apply()
    session.filter("StreamingPoisson")
    session.event(PANEL + "/SearchBox/AdvancedButton", "activate")
    session.name_file("ProblemFileName", path("problem.json"))
    session.apply()
    session.save_data(path("gui.vsm"))
    session.run(arguments.timeout)

    expected = results(simple, path("smg.vsm"))
    for door in ("file", "arrays", "gui"):
        found = results(simple, path(door + ".vsm"))
        for name, values in expected.items():
            assert found[name] == values, (door, name)
    os.write(1, b"passed\n")


if __name__ == "__main__":
    play(read_arguments())
