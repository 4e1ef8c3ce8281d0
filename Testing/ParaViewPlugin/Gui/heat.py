# SPDX-License-Identifier: BSD-3-Clause
"""The steps of docs/solve.md in the real ParaView: converts the heat sink, says by five conditions
what holds in which group, solves, and saves the mesh with its temperatures.

    heat.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import os
import sys

from paraview_gui import PROPERTIES, Session, read_arguments


def hold(session, group, condition, value, coefficient=None):
    """A condition in a group."""
    session.filter("MeshCondition")
    session.choose("Region", "Group")
    session.choose("GroupName", group)
    session.choose("Condition", condition)
    session.write("Value/DoubleLineEdit0", value)
    if coefficient is not None:
        session.write("Coefficient/DoubleLineEdit0", coefficient)
    session.apply()


def play(arguments):
    folder = os.path.abspath(arguments.folder)
    result = os.path.join(folder, "heat.vsm")
    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.source("StreamingMeshConverter")
    session.name_file("FileName", arguments.mesh)
    session.name_file("OutputFileName", os.path.join(folder, "heat_sink.vsm"))
    session.apply()

    hold(session, "chip", "Conductivity", 25)
    hold(session, "heat sink", "Conductivity", 200)
    session.picture("heat-part")
    hold(session, "chip", "Source", 5e7)
    hold(session, "solder", "Flux", -10000)
    hold(session, "air", "Robin", 20, 50)
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


def cooled():
    condition = GetActiveSource()
    condition.UpdatePropertyInformation()
    assert list(condition.GetPropertyValue("GroupNames")) == ["solder", "air", "chip", "heat sink"]
    Render()


def solved():
    heat = GetActiveSource()
    heat.UpdatePropertyInformation()
    report = json.loads(heat.GetPropertyValue("Report"))
    assert report["converged"] and report["vertices"] == 1740, report
    board, air = report["conditions"]
    assert (board["name"], air["name"]) == ("flux[0] (solder)", "robin[0] (air)")
    assert abs(board["flux"][0] + 1.96) < 1e-9 and abs(air["flux"][0] + 17.64) < 1e-6, report
    assert 77 < report["maximum"][0]["value"] < 78, report
    assert {"Gradient", "Flux"} <= set(heat.CellData.keys())
    Render()
