# SPDX-License-Identifier: BSD-3-Clause
"""The steps of docs/solve.md in the real ParaView: converts the heat sink, says by four conditions
what holds where, solves, and saves the mesh with its temperatures.

    heat.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import os
import sys

from paraview_gui import PROPERTIES, Session, read_arguments

FUNCTION = "RegionFunction/ProxySelectionWidget/"
PLANE = FUNCTION + "frame/ChosenProxyWidget/InteractivePlane/"


def hold(session, condition, value, height, inside_out=False):
    """A condition on one side of a horizontal plane."""
    session.filter("MeshCondition")
    session.event(f"{PROPERTIES}/{FUNCTION}comboBox", "set_string", "Plane")
    session.write_vector(PLANE + "origin", "XYZ", (0, 0, height))
    session.event(f"{PROPERTIES}/{PLANE}useZNormal", "activate")
    if inside_out:
        session.event(f"{PROPERTIES}/InsideOut/CheckBox", "set_boolean", "true")
    session.choose("Condition", condition)
    session.write("Value/DoubleLineEdit0", value)


def play(arguments):
    folder = os.path.abspath(arguments.folder)
    result = os.path.join(folder, "heat.vsm")
    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.source("StreamingMeshConverter")
    session.name_file("FileName", arguments.mesh)
    session.name_file("OutputFileName", os.path.join(folder, "heat_sink.vsm"))
    session.apply()

    session.filter("MeshCondition")
    session.choose("Region", "Everywhere")
    session.choose("Condition", "Conductivity")
    session.write("Value/DoubleLineEdit0", 25)
    session.apply()

    session.filter("MeshCondition")
    session.choose("Region", "Tag")
    session.choose("TagArray", "Material")
    session.write("Tag/DoubleLineEdit0", 2)
    session.choose("Condition", "Conductivity")
    session.write("Value/DoubleLineEdit0", 200)
    session.apply()
    session.picture("heat-tag")

    hold(session, "Flux", 100000, 0.001)
    session.apply()
    session.checkpoint("heated")

    hold(session, "Robin", 20, 0.005, inside_out=True)
    session.write("Coefficient/DoubleLineEdit0", 100)
    session.apply()
    session.checkpoint("cooled")
    session.picture("heat-conditions")

    session.filter("StreamingPoisson")
    session.scroll_panel(600)
    session.event(f"{PROPERTIES}/Gradient/CheckBox", "set_boolean", "true")
    session.event(f"{PROPERTIES}/Flux/CheckBox", "set_boolean", "true")
    session.apply()
    session.scroll_panel(0)
    session.checkpoint("solved")
    session.picture("heat-solved")
    session.save_data(result)
    session.run(arguments.timeout)
    assert os.path.exists(result)
    print("passed")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

import json

from paraview.simple import *


def held(count):
    condition = GetActiveSource()
    condition.UpdatePropertyInformation()
    assert condition.GetPropertyValue("NumberOfHeldPoints") == count
    Render()


def heated():
    held(64)


def cooled():
    held(1404)


def solved():
    heat = GetActiveSource()
    heat.UpdatePropertyInformation()
    report = json.loads(heat.GetPropertyValue("Report"))
    assert report["converged"] and report["vertices"] == 2116, report
    heating, air = report["conditions"]
    assert (heating["name"], air["name"]) == ("flux[0]", "robin[0]")
    assert abs(heating["flux"][0] - 19.6) < 1e-6 and abs(air["flux"][0] + 19.6) < 1e-6, report
    assert 67 < report["maximum"][0]["value"] < 68, report
    assert {"Gradient", "Flux"} <= set(heat.CellData.keys())
    Render()
