# SPDX-License-Identifier: BSD-3-Clause
"""The panels of the filters in the real ParaView: each filter of a region with each kind of region, the box of a
handle's transform, and the panels of the solvers. The pictures are for the eye; the checkpoints assert what a script
can.

    panels.py PLUGIN MESH FOLDER [--pictures FOLDER] [--timeout SECONDS]

The functions without arguments at the end are the checkpoints, which run inside ParaView.
"""

import os
import sys

from paraview_gui import PROPERTIES, Session, read_arguments

WIDGET = "RegionFunction/ProxySelectionWidget/frame/ChosenProxyWidget/InteractiveSphere/"
EAR, RADIUS = (-0.0175, 0.187, -0.02), 0.03


def play(arguments):
    session = Session(arguments.folder, arguments.plugin, __file__, arguments.pictures)
    session.open(arguments.mesh)
    session.apply()
    session.checkpoint("opened")
    session.filter("MeshRegion")
    session.choose("Region", "Boundary")
    session.apply()
    session.checkpoint("marked")
    session.check("Outcome/Text", "text", "223 points.")
    session.picture("region-boundary")
    session.choose("Region", "Mask")
    session.picture("region-mask")
    session.choose("Region", "Tag")
    session.picture("region-tag")
    session.choose("Region", "Boundary")
    session.filter("StreamingDistance")
    session.apply()
    session.checkpoint("measured")
    session.picture("distance")
    session.scroll_panel(1000)
    session.picture("distance-below")
    session.scroll_panel(0)
    session.checkpoint("select_region")
    session.filter("StreamingMeshSmoothing")
    session.apply()
    session.checkpoint("smoothed")
    session.check("EdgeAngle/Unit", "text", "degrees")
    session.picture("smoothing")
    session.checkpoint("select_mesh")
    session.filter("MeshHandle")
    session.write_vector(WIDGET + "center", "XYZ", EAR)
    session.write(WIDGET + "radius", RADIUS)
    session.event(f"{PROPERTIES}/{WIDGET}show3DWidget", "set_boolean", "false")
    session.choose("Motion", "Transform")
    session.apply()
    session.checkpoint("boxed")
    session.scroll_panel(330)
    session.picture("box")
    session.choose("Motion", "Similarity")
    session.check("RotationAngle/Unit", "text", "degrees")
    session.picture("similarity")
    session.scroll_panel(0)
    session.checkpoint("select_mesh")
    session.filter("StreamingBlend")
    session.picture("blend")
    session.run(arguments.timeout)
    os.write(1, b"passed\n")


if __name__ == "__main__":
    play(read_arguments())
    sys.exit()

from paraview.simple import *

notes = sys.modules.setdefault("panels_notes", type(sys)("panels_notes"))


def opened():
    notes.mesh = GetActiveSource()
    Render()


def marked():
    notes.region = GetActiveSource()
    assert notes.region.Region == "Boundary"
    notes.region.UpdatePropertyInformation()
    assert notes.region.GetPropertyValue("NumberOfHeldPoints") == 223


def measured():
    source = GetActiveSource()
    assert source.Input.GetGlobalID() == notes.region.GetGlobalID() and source.From == ""


def smoothed():
    assert GetActiveSource().Input.GetGlobalID() == notes.region.GetGlobalID()


def select_region():
    SetActiveSource(notes.region)


def select_mesh():
    SetActiveSource(notes.mesh)


def boxed():
    handle = GetActiveSource()  # whose panel says so without being asked
    bounds = list(handle.GetPropertyValue("HeldBounds"))
    assert all(abs(b - c) <= RADIUS for b, c in zip(bounds, (EAR[0], EAR[0], EAR[1], EAR[1], EAR[2], EAR[2]))), bounds
    assert handle.Transform.GetXMLName() == "HandleTransform", handle.Transform.GetXMLName()
    reference = handle.Transform.SMProxy.GetProperty("ReferenceBounds")
    assert [reference.GetElement(i) for i in range(6)] == bounds
    Render()
