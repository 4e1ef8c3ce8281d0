# SPDX-License-Identifier: BSD-3-Clause
"""The steps of Examples/Smoothing/gui in the real ParaView: opens the bunny, smooths it with the
defaults, then by another size in more steps, shows a preview instead, and saves the mesh: the same
bits as those of smg smooth.

    smoothing.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The environment variable SMG_PROGRAM names smg. The functions without arguments at the end are the
checkpoints, which run inside ParaView.
"""

import os
import subprocess
import sys

from paraview_gui import Session, read_arguments

SIZE, STEPS = 12, 3


def arrays(simple, path):
    """The bytes of the points, of the cells and of each point array."""
    from paraview import servermanager
    from paraview.vtk.util.numpy_support import vtk_to_numpy

    data = servermanager.Fetch(simple.StreamingMeshReader(FileName=path))
    points = data.GetPointData()
    found = {points.GetArrayName(k): points.GetArray(k) for k in range(points.GetNumberOfArrays())}
    found["Points"] = data.GetPoints().GetData()
    found["Cells"] = data.GetPolys().GetConnectivityArray()
    return {name: vtk_to_numpy(array).tobytes() for name, array in found.items()}


def play(arguments):
    from paraview import simple

    folder = os.path.abspath(arguments.folder)
    result, expected = (os.path.join(folder, name) for name in ("gui.vsm", "smg.vsm"))
    subprocess.run([os.environ["SMG_PROGRAM"], "smooth", arguments.mesh, expected, "--quiet",
                    "--size", f"{SIZE}edges", "--steps", str(STEPS)], check=True)

    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.open(arguments.mesh)
    session.apply()
    session.checkpoint("opened")
    session.filter("StreamingMeshSmoothing")
    session.apply()
    session.checkpoint("smoothed_by_defaults")
    session.picture("smoothing-defaults")
    session.write("Size/DoubleLineEdit0", SIZE)
    session.write("Steps/LineEdit0", STEPS)
    session.apply()
    session.checkpoint("smoothed")
    session.picture("smoothing-size")
    session.scroll_panel(400)
    session.picture("smoothing-outcome")
    session.scroll_panel(0)
    session.choose("Solve", "Preview")
    session.apply()
    session.checkpoint("select_mesh")
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.checkpoint("select_smoothing")
    session.scroll_panel(400)
    session.picture("smoothing-preview")
    session.save_data(result)
    session.run(arguments.timeout)

    simple.LoadPlugin(arguments.plugin, ns=simple.__dict__)
    found = arrays(simple, result)
    assert found == arrays(simple, expected)
    assert found["Points"] != arrays(simple, arguments.mesh)["Points"]
    os.write(1, b"passed\n")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

import json

from paraview.simple import *

notes = sys.modules.setdefault("smoothing_notes", type(sys)("smoothing_notes"))


def opened():
    notes.mesh = GetActiveSource()
    camera = GetActiveCamera()
    camera.SetPosition(-0.05, 0.16, 0.38)
    camera.SetFocalPoint(-0.017, 0.11, 0.0)
    camera.SetViewUp(0, 1, 0)
    Render()


def report():
    notes.smoothing.UpdatePropertyInformation()
    found = json.loads(notes.smoothing.GetPropertyValue("Report"))
    assert found["converged"], found
    assert "Converged " in notes.smoothing.GetPropertyValue("Outcome"), found
    return found


def smoothed_by_defaults():
    notes.smoothing = GetActiveSource()
    assert report()["vertices"] == 34834 and len(report()["steps"]) == 1
    assert notes.smoothing.Array == "None"
    Render()


def smoothed():
    assert (notes.smoothing.Size, notes.smoothing.SizeUnit) == (SIZE, "Mean Edges")
    assert report()["vertices"] == 34834 and len(report()["steps"]) == STEPS
    Render()


def select_mesh():
    SetActiveSource(notes.mesh)


def select_smoothing():
    SetActiveSource(notes.smoothing)
    Render()
    assert report()["vertices"] <= 10000 and len(report()["steps"]) == STEPS
    assert "this is the smoothed preview" in notes.smoothing.GetPropertyValue("Notes")
