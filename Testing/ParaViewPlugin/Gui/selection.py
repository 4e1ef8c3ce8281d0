# SPDX-License-Identifier: BSD-3-Clause
"""A handle by selection in the real ParaView: points of the preview are selected with the mouse and
copied into the handle, which holds what they stand for in the whole mesh.

    selection.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import os
import sys

from paraview_gui import PROPERTIES, SELECT_POINTS, Session, read_arguments


def play(arguments):
    result = os.path.join(os.path.abspath(arguments.folder), "held.vsm")
    session = Session(arguments.folder, arguments.plugin, __file__, arguments.pictures)
    session.open(os.path.abspath(arguments.mesh))
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.event(SELECT_POINTS, "activate")
    session.drag((0.25, 0.2), (0.42, 0.45))
    session.filter("MeshHandle")
    session.choose("Region", "Selection")
    session.event(PROPERTIES + "/Selection/Selection/pushButtonCopySelection", "activate")
    session.apply()
    session.checkpoint("selected")
    session.picture("selected")
    session.save_data(result)
    session.checkpoint("saved")
    session.run(arguments.timeout)
    assert os.path.exists(result)
    print("passed")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

from paraview.simple import *

notes = sys.modules.setdefault("selection_notes", type(sys)("selection_notes"))


def held():
    handle = GetActiveSource()
    handle.UpdatePropertyInformation()
    return handle.GetPropertyValue("NumberOfHeldPoints")


def selected():
    handle = GetActiveSource()
    notes.share = held() / handle.GetDataInformation().GetNumberOfPoints()
    assert 0.01 < notes.share < 0.5, notes.share
    # A state in Python has the selection.
    from paraview import smstate

    script = smstate.get_state()
    assert "Region = 'Selection'" in script and "servermanager.sources.IDSelectionSource(" in script, script
    ClearSelection()
    ColorBy(GetDisplayProperties(), ("POINTS", "HandleMask"))
    Render()


def saved():
    # About the same part of the mesh as of its preview.
    reader = GetActiveSource().Input
    reader.UpdatePropertyInformation()
    share = held() / reader.GetPropertyValue("FullNumberOfPoints")
    assert 0.8 * notes.share < share < 1.25 * notes.share, (share, notes.share)
