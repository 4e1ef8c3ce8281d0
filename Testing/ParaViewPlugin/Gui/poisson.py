# SPDX-License-Identifier: BSD-3-Clause
"""The steps of docs/paraview.md in the real ParaView, as they stand there: opens a scan in millimetres above
the guard, holds two ends by conditions, solves on the preview, then on the full mesh, and saves the field.

    poisson.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import os
import subprocess
import sys

from paraview_gui import PROPERTIES, Session, read_arguments

FUNCTION = "RegionFunction/ProxySelectionWidget/"
PLANE = FUNCTION + "frame/ChosenProxyWidget/InteractivePlane/"
ESTIMATE = ("About 34,834 points and 69,451 cells: a reader that reads all of it takes at least 3 MiB, the conversion "
            "256 MiB")
FEET, EARS = 36, 180  # the bunny's, in millimetres


def hold(session, height, value, inside_out):
    """A condition on one side of a horizontal plane."""
    session.filter("MeshCondition")
    session.event(f"{PROPERTIES}/{FUNCTION}comboBox", "set_string", "Plane")
    session.write_vector(PLANE + "origin", "XYZ", (0, height, 0))
    session.event(f"{PROPERTIES}/{PLANE}useYNormal", "activate")
    if inside_out:
        session.event(f"{PROPERTIES}/InsideOut/CheckBox", "set_boolean", "true")
    session.write("Value/DoubleLineEdit0", value)
    session.apply()
    session.checkpoint("held")
    session.picture(f"condition-{value}")
    session.checkpoint("show_another")


def write_scan(plugin, mesh, path):
    """The mesh, which is in metres, as a PLY file in millimetres."""
    from paraview import simple

    simple.LoadPlugin(plugin, ns=simple.__dict__)
    scan = simple.Transform(Input=simple.OpenDataFile(mesh))
    scan.Transform.Scale = [1000.0] * 3
    simple.SaveData(path, scan)


def play(arguments):
    folder = os.path.abspath(arguments.folder)
    scan, mesh, result = (os.path.join(folder, name) for name in ("scan.ply", "scan.vsm", "field.vsm"))
    write_scan(arguments.plugin, arguments.mesh, scan)
    session = Session(arguments.folder, arguments.plugin, __file__, arguments.pictures)
    session.source("StreamingMeshConverter")
    session.name_file("FileName", scan)
    # Known before Apply: the file to write, beside the scan, and what that costs.
    session.check("OutputFileName/FileChooser/FileLineEdit", "text", mesh)
    session.check("Estimate/Text", "text", ESTIMATE)
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.checkpoint("opened")
    session.picture("opened")
    hold(session, FEET, 0, False)
    hold(session, EARS, 1, True)
    session.filter("StreamingPoisson")
    session.choose("Solve", "Preview")
    session.apply()
    session.checkpoint("solved")
    session.picture("solved")
    session.scroll_panel(400)
    session.picture("last-solve")
    session.scroll_panel(0)
    session.choose("Solve", "Full Mesh")
    session.apply()
    session.checkpoint("solved_in_full")
    session.picture("solved-in-full")
    session.save_data(result)
    session.checkpoint("saved")
    session.run(arguments.timeout)
    assert os.path.exists(result)
    print("passed")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

import json

from paraview.simple import *

notes = sys.modules.setdefault("poisson_notes", type(sys)("poisson_notes"))


def report(proxy):
    proxy.UpdatePropertyInformation()
    return json.loads(proxy.GetPropertyValue("Report"))


def opened():
    bounds = GetActiveSource().GetDataInformation().GetBounds()
    assert bounds[2] < FEET < EARS < bounds[3], bounds
    Render()
    # Without that anyone asks for it, the view says that this is a preview.
    hidden = GetActiveView().SMProxy.GetProperty("HiddenRepresentations")
    lines = [hidden.GetProxy(k).GetProperty("Text") for k in range(hidden.GetNumberOfProxies())]
    points = GetActiveSource().GetDataInformation().GetNumberOfPoints()
    assert f"{points:,} of 34,834 points" in [line.GetElement(0) for line in lines if line], lines


def held():
    condition = GetActiveSource()
    condition.UpdatePropertyInformation()
    count = condition.GetPropertyValue("NumberOfHeldPoints")
    assert 0 < count < condition.GetDataInformation().GetNumberOfPoints() / 4, count
    Render()


def show_another():
    """Another array is shown, and active, when the next filter is made."""
    ColorBy(GetDisplayProperties(GetActiveSource()), ("POINTS", "Condition1"))
    HideUnusedScalarBars()
    Render()


def between_the_ends(source):
    low, high = source.PointData["Solution"].GetRange()
    return -0.02 < low <= 0 and 1 <= high < 1.02


def solved():
    poisson = GetActiveSource()
    notes.poisson = poisson
    for name in ("DirichletMask", "DirichletValues", "Source", "InitialGuess", "ScreeningArray",
                 "ConductivityArray", "FieldArray"):
        assert list(poisson.GetPropertyValue(name))[-1] == "None", name
    assert between_the_ends(poisson), poisson.PointData["Solution"].GetRange()
    assert report(poisson)["converged"] and report(poisson)["vertices"] < 30000
    assert any("preview" in note for note in report(poisson)["notes"])
    colored = GetDisplayProperties(poisson).ColorArrayName
    assert list(colored) == ["POINTS", "Solution"], list(colored)
    Render()


def solved_in_full():
    assert between_the_ends(notes.poisson)
    assert report(notes.poisson)["converged"] and report(notes.poisson)["vertices"] > 30000
    Render()


def saved():
    assert report(notes.poisson)["vertices"] > 30000
