# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of the plugin."""

import atexit
import os
import shutil
import subprocess
import tempfile

from paraview import servermanager
from paraview.simple import *
from paraview.vtk import vtkOutputWindow, vtkStringOutputWindow
from paraview.vtk.util.numpy_support import vtk_to_numpy

BUNNY = os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "bunny.smb")
BUNNY_POINTS, BUNNY_CELLS = 34834, 69451

# The ends of the bunny, held at their own positions, with a constant source.
FEET, EARS, SOURCE = 0.04, 0.17, 2.0


def skip(reason):
    print("SKIPPED:", reason)
    raise SystemExit(0)


def make_folder():
    """A temporary folder, deleted at the end of the test."""
    folder = tempfile.mkdtemp(prefix="smg-test-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def make_shared_folder():
    """The same for the processes of a parallel test: one folder, deleted by process 0."""
    from paraview.vtk import vtkMultiProcessController, vtkUnsignedCharArray

    controller = vtkMultiProcessController.GetGlobalController()
    name = vtkUnsignedCharArray()
    for byte in make_folder().encode() if controller.GetLocalProcessId() == 0 else b"":
        name.InsertNextValue(byte)
    controller.Broadcast(name, 0)
    return bytes(name.GetValue(i) for i in range(name.GetNumberOfTuples())).decode()


def make_problem(reader, axis="Y", low=FEET, high=EARS):
    """Calculators that make the arrays Mask and Values (three components): the points up to `low`
    and from `high` on along the axis are held at their positions."""
    mask = Calculator(Input=reader)
    mask.ResultArrayName = "Mask"
    mask.Function = f"(coords{axis} <= {low}) | (coords{axis} >= {high})"
    values = Calculator(Input=mask)
    values.ResultArrayName = "Values"
    values.Function = "coords"
    return values


# Four scans of different brightness: functions of the position x, y, z and of the scan.
SCAN, LIGHT = "(x > -0.02) + 2 * (y > 0.1)", "128 + 512 * z + 32 * Scan"


def make_scans(reader):
    """Calculators that make the arrays Scan, of four patches, and Light, with steps between them."""
    function = SCAN.replace("x", "coordsX").replace("y", "coordsY")
    scan = Calculator(Input=reader, ResultArrayName="Scan", Function=function)
    return Calculator(Input=scan, ResultArrayName="Light", Function=LIGHT.replace("z", "coordsZ"))


def make_vtk_scans(reader):
    """The same by classes of VTK."""
    from paraview.vtk.vtkFiltersCore import vtkArrayCalculator

    for name, function in (("Scan", SCAN), ("Light", LIGHT)):
        array = vtkArrayCalculator()
        array.SetInputConnection(reader.GetOutputPort())
        array.SetAttributeTypeToPointData()
        for axis, coordinate in enumerate("xyz"):
            array.AddCoordinateScalarVariable(coordinate, axis)
        if name == "Light":
            array.AddScalarVariable("Scan", "Scan", 0)
        array.SetFunction(function)
        array.SetResultArrayName(name)
        reader = array
    return reader


def make_poisson(source):
    poisson = StreamingPoisson(Input=source)
    poisson.DirichletMask = ["POINTS", "Mask"]
    poisson.DirichletValues = ["POINTS", "Values"]
    poisson.InitialGuess = ["POINTS", "Values"]
    return poisson


class Silence:
    """Messages are collected, and not shown."""

    def __enter__(self):
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        return self.window

    def __exit__(self, *_):
        vtkOutputWindow.SetInstance(None)


def client_object(proxy):
    return proxy.SMProxy.GetClientSideObject()


def pull(algorithm, pieces, array=None):
    """Requests all pieces of a VTK algorithm: for each, ids, own points, positions, values, cells."""
    result = []
    for piece in range(pieces):
        algorithm.UpdatePiece(piece, pieces, 0)
        data = algorithm.GetOutputDataObject(0)
        points = data.GetPointData()
        ids = vtk_to_numpy(points.GetGlobalIds()).copy()
        own = vtk_to_numpy(points.GetArray("vtkGhostType")).copy() == 0
        positions = vtk_to_numpy(data.GetPoints().GetData()).copy()
        values = vtk_to_numpy(points.GetArray(array)).copy() if array else None
        cells = data.GetPolys() if data.IsA("vtkPolyData") else data.GetCells()
        corners = ids[vtk_to_numpy(cells.GetConnectivityArray())]
        result.append((ids, own, positions, values, corners))
    return result


def run_smg(*arguments):
    program = os.environ.get("SMG_PROGRAM")
    if not program:
        skip("the program smg is not built")
    subprocess.run([program, *map(str, arguments)], check=True, timeout=5000)


def points_of(proxy, array):
    """A point array of the output as (points, components)."""
    values = vtk_to_numpy(servermanager.Fetch(proxy).GetPointData().GetArray(array))
    return values.reshape(len(values), -1)
