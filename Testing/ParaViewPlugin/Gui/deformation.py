# SPDX-License-Identifier: BSD-3-Clause
"""A user's way through the real ParaView: opens a mesh above the guard by the converter, adds two
handles with their widgets, deforms the preview, drags a handle while the preview follows, saves the
whole mesh by File > Save Data, and opens what was saved.

    deformation.py PLUGIN MESH FOLDER [--pictures FOLDER] [--guard POINTS] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import json
import os
import sys

from paraview_gui import AUTO_APPLY, PROPERTIES, Session, read_arguments

# The handles by the name of the mesh: fixed below a height, turned within a ball.
SCENES = {
    "bunny": {"floor": (-0.017, 0.06, 0.0), "ball": (-0.065, 0.145, 0.005), "radius": 0.05,
              "angle": 40, "scale": 1.2, "center": (-0.05, 0.12, 0.0)},
    "armadillo": {"floor": (0.0, -0.42, 0.0), "ball": (0.0, 0.3, 0.1), "radius": 0.28,
                  "angle": 70, "scale": 1.3, "center": (0.0, 0.1, 0.05)},
}
FUNCTION = "RegionFunction/ProxySelectionWidget/"
WIDGET = FUNCTION + "frame/ChosenProxyWidget/"


def play(arguments):
    scene = next(SCENES[name] for name in SCENES if name in os.path.basename(arguments.mesh))
    stem = os.path.join(os.path.abspath(arguments.folder), os.path.splitext(os.path.basename(arguments.mesh))[0])
    result = stem + "-deformed.vsm"
    session = Session(arguments.folder, arguments.plugin, __file__, arguments.pictures)

    session.source("StreamingMeshConverter")
    session.name_file("FileName", arguments.mesh)
    session.name_file("OutputFileName", stem + ".vsm")
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.checkpoint("opened")
    session.picture("opened")

    session.filter("MeshHandle")
    session.event(f"{PROPERTIES}/{FUNCTION}comboBox", "set_string", "Plane")
    session.write_vector(WIDGET + "InteractivePlane/origin", "XYZ", scene["floor"])
    session.event(f"{PROPERTIES}/{WIDGET}InteractivePlane/useYNormal", "activate")
    session.apply()
    session.checkpoint("held")

    session.filter("MeshHandle")
    session.write_vector(WIDGET + "InteractiveSphere/center", "XYZ", scene["ball"])
    session.write(WIDGET + "InteractiveSphere/radius", scene["radius"])
    session.choose("Motion", "Similarity")
    session.write_vector("RotationAxis/DoubleLineEdit", "012", (0, 1, 0))
    session.write("RotationAngle/DoubleLineEdit0", scene["angle"])
    session.write("Scale/DoubleLineEdit0", scene["scale"])
    session.write_vector("InteractiveHandle/worldPosition", "XYZ", scene["center"])
    session.apply()
    session.scroll_panel(130)
    session.checkpoint("turned")
    session.picture("handles")

    session.filter("StreamingMeshDeformation")
    session.apply()
    session.scroll_panel(0)
    session.checkpoint("deformed")
    session.picture("deformed")

    # The second handle again, now by dragging its box with the mouse.
    session.checkpoint("select_handle")
    session.event(f"{PROPERTIES}/{WIDGET}InteractiveSphere/show3DWidget", "set_boolean", "false")
    session.choose("Motion", "Transform")
    session.apply()
    session.checkpoint("boxed")
    session.event(AUTO_APPLY, "activate")
    session.drag((0.5, 0.5), (0.57, 0.45))
    session.event(AUTO_APPLY, "activate")
    session.scroll_panel(330)
    session.checkpoint("dragged")
    session.picture("dragged")

    session.checkpoint("select_deformation")
    session.save_data(result)
    session.checkpoint("saved")
    session.open(result)
    session.write("MaximumPointsInMemory/LineEdit0", arguments.guard)
    session.write("PreviewPoints/IntRangeWidget/LineEdit", 10000)
    session.apply()
    session.scroll_panel(0)
    session.checkpoint("reopened")
    session.picture("reopened")
    session.run(arguments.timeout)
    assert os.path.getsize(result) > os.path.getsize(stem + ".vsm") / 2
    print("passed")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

from paraview.simple import *

notes = sys.modules.setdefault("deformation_notes", type(sys)("deformation_notes"))


def number(proxy, name):
    proxy.UpdatePropertyInformation()
    return proxy.GetPropertyValue(name)


def is_preview(source):
    fields = source.GetDataInformation().DataInformation.GetFieldDataInformation()
    return fields.GetArrayInformation("Preview") is not None


def points(source):
    return source.GetDataInformation().GetNumberOfPoints()


def opened():
    converter = GetActiveSource()
    notes.mesh = number(converter, "FullNumberOfPoints")
    assert notes.mesh > converter.MaximumPointsInMemory
    assert is_preview(converter) and 0 < points(converter) <= converter.PreviewPoints
    notes.bounds = converter.GetDataInformation().GetBounds()
    Render()


def held():
    notes.floor = GetActiveSource()
    assert 0 < number(notes.floor, "NumberOfHeldPoints") < points(notes.floor)


def turned():
    notes.handle = GetActiveSource()
    assert is_preview(notes.handle)
    assert 0 < number(notes.handle, "NumberOfHeldPoints") < points(notes.handle)
    assert notes.handle.Motion == "Similarity"
    display = GetDisplayProperties()
    ColorBy(display, ("POINTS", "HandleMask"))
    Render()


def deformed():
    notes.deformation = GetActiveSource()
    assert is_preview(notes.deformation)
    assert points(notes.deformation) == points(notes.handle)
    assert notes.deformation.GetDataInformation().GetBounds() != notes.bounds
    assert number(notes.deformation, "NumberOfBuilds") == 1
    Render()


def select_handle():
    SetActiveSource(notes.handle)


def boxed():
    # Moves the middle of the box, which lies around the held points, to the middle of the view, where
    # the mouse picks it, and its faces to the sides.
    view = GetActiveView()
    bounds = list(number(notes.handle, "HeldBounds"))
    middle = [(low + high) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]
    distance = sum((p - f)**2 for p, f in zip(view.CameraPosition, view.CameraFocalPoint))**0.5
    view.CameraFocalPoint = middle
    view.CameraPosition = [m + distance * d for m, d in zip(middle, (0.4, 0.3, 0.87))]
    notes.undragged = notes.deformation.GetDataInformation().GetBounds()
    notes.updates = 0

    def count(*_):
        notes.updates += 1

    notes.deformation.SMProxy.AddObserver("UpdateDataEvent", count)
    Render()


def dragged():
    print(list(notes.handle.Transform.Translate), notes.updates)
    assert list(notes.handle.Transform.Translate) != [0, 0, 0], "the box was not dragged"
    assert notes.updates > 3, f"the preview followed only {notes.updates} times"
    assert notes.deformation.GetDataInformation().GetBounds() != notes.undragged
    assert number(notes.deformation, "NumberOfBuilds") == 1
    Render()


def select_deformation():
    SetActiveSource(notes.deformation)


def saved():
    report = json.loads(number(notes.deformation, "Report"))
    assert report["vertices"] == notes.mesh and report["converged"], report
    Hide(notes.deformation)


def reopened():
    reader = GetActiveSource()
    assert number(reader, "FullNumberOfPoints") == notes.mesh
    assert is_preview(reader)
    bounds = reader.GetDataInformation().GetBounds()
    wanted = notes.deformation.GetDataInformation().GetBounds()
    size = max(b - a for a, b in zip(wanted[0::2], wanted[1::2]))
    assert max(abs(a - b) for a, b in zip(bounds, wanted)) < 0.1 * size, (bounds, wanted)
    assert max(abs(a - b) for a, b in zip(bounds, notes.bounds)) > 0.02 * size
    Render()
