# SPDX-License-Identifier: BSD-3-Clause
"""The steps of Examples/Blending/gui in the real ParaView: opens the bunny with the light of four
scans, blends it, holds one scan, shows a preview instead, and saves the mesh: the same bits as those
of smg blend.

    blending.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The environment variable SMG_PROGRAM names smg. The functions without arguments at the end are the
checkpoints, which run inside ParaView.
"""

import os
import subprocess
import sys

from paraview_gui import AUTO_APPLY, PROPERTIES, Session, read_arguments

HOLD = '{"sphere": [-0.07, 0.14, 0.02, 0.03]}'


def light_of(simple, path):
    """The array Light of a saved mesh."""
    from paraview import servermanager
    from paraview.vtk.util.numpy_support import vtk_to_numpy

    data = servermanager.Fetch(simple.StreamingMeshReader(FileName=path))
    return vtk_to_numpy(data.GetPointData().GetArray("Light")).copy()


def play(arguments):
    from paraview import simple

    folder = os.path.abspath(arguments.folder)
    recorded, result, expected = (os.path.join(folder, name + ".vsm")
                                  for name in ("recorded", "gui", "smg"))
    session = Session(folder, arguments.plugin, __file__, arguments.pictures)
    session.open(arguments.mesh)
    session.apply()
    session.checkpoint("recorded")
    session.picture("blending-recorded")
    session.save_data(recorded)
    session.filter("StreamingBlend")
    session.choose("Solve", "Preview")
    session.choose("Patch", "Scan")
    columns = f"{PROPERTIES}/Arrays/ArraySelectionWidget"
    session.event(columns, "currentChanged", "/0|0")
    session.event(columns, "key", ord(" "))
    session.apply()
    session.checkpoint("blended")
    session.picture("blending-blended")
    session.scroll_panel(400)
    session.picture("blending-outcome")
    # What the filter says cannot be overwritten.
    session.check("Outcome/Text", "wordWrap", "true")
    session.check("MemoryLimit/Unit", "text", "MiB")
    session.scroll_panel(0)
    session.write("Hold/Hold", HOLD)
    session.apply()
    session.checkpoint("held")
    session.checkpoint("select_mesh")
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.checkpoint("select_blend")
    # The preview follows a slider.
    session.event(AUTO_APPLY, "activate")
    for percent in (20, 45, 80):
        session.event(f"{PROPERTIES}/Anchor/DoubleRangeWidget/Slider", "set_int", percent)
    session.event(AUTO_APPLY, "activate")
    session.checkpoint("slid")
    session.write("Anchor/DoubleRangeWidget/DoubleLineEdit", 0.01)
    session.apply()
    session.save_data(result)
    session.run(arguments.timeout)

    subprocess.run([os.environ["SMG_PROGRAM"], "blend", recorded, expected, "--quiet",
                    "--patch", "Scan", "--columns", "Light", "--hold", HOLD], check=True)
    simple.LoadPlugin(arguments.plugin, ns=simple.__dict__)
    before, found, wanted = (light_of(simple, path) for path in (recorded, result, expected))
    assert (found == wanted).all()
    assert (found != before).any()
    os.write(1, b"passed\n")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

import json

from paraview.simple import *

notes = sys.modules.setdefault("blending_notes", type(sys)("blending_notes"))


def show(source):
    display = Show(source)
    ColorBy(display, ("POINTS", "Light"))
    GetColorTransferFunction("Light").RescaleTransferFunction(100, 280)
    Render()


def recorded():
    notes.mesh = GetActiveSource()
    scan = Calculator(Input=notes.mesh, ResultArrayName="Scan",
                      Function="(coordsX > -0.02) + 2 * (coordsY > 0.1)")
    notes.light = Calculator(Input=scan, ResultArrayName="Light",
                             Function="128 + 512 * coordsZ + 32 * Scan")
    SetActiveSource(notes.light)
    Hide(notes.mesh)
    camera = GetActiveCamera()
    camera.SetPosition(-0.12, 0.22, 0.45)
    camera.SetFocalPoint(-0.017, 0.11, 0.0)
    camera.SetViewUp(0, 1, 0)
    show(notes.light)


def report():
    notes.blend.UpdatePropertyInformation()
    found = json.loads(notes.blend.GetPropertyValue("Report"))
    assert found["converged"], found
    assert "Converged " in notes.blend.GetPropertyValue("Outcome"), found
    (seam,) = found["seams"]
    assert seam["column"] == "Light" and seam["after"] < 0.15 * seam["before"], seam
    return found


def blended():
    notes.blend = GetActiveSource()
    assert notes.blend.Patch == "Scan" and list(notes.blend.Arrays) == ["Light"]
    assert report()["vertices"] == 34834 and report()["prescribed"] == 0
    show(notes.blend)


def held():
    assert report()["vertices"] == 34834 and report()["prescribed"] > 1000


def select_mesh():
    SetActiveSource(notes.mesh)


def select_blend():
    SetActiveSource(notes.blend)
    Render()
    assert report()["vertices"] <= 10000
    assert "this is the blended preview" in notes.blend.GetPropertyValue("Notes")
    notes.range = light_range()


def light_range():
    return notes.blend.GetDataInformation().GetPointDataInformation().GetArrayInformation(
        "Light").GetComponentRange(0)


def slid():
    assert notes.blend.Anchor > 50, notes.blend.Anchor
    assert light_range() != notes.range
    # Each value of the slider gives another preview.
    ranges = set()
    for anchor in (1, 30, 10, 80):
        notes.blend.Anchor = anchor
        notes.blend.UpdatePipeline()
        ranges.add(tuple(light_range()))
    assert len(ranges) == 4, ranges
