# SPDX-License-Identifier: BSD-3-Clause
"""Every filter of the category on small sources of ParaView, with its default properties: a result, or one sentence that
says what is missing, in words that a user of the pipeline knows."""

import re
import sys

import smg_testing as t
from paraview.simple import *
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING

LoadPlugin(sys.argv[1], ns=globals())

SOURCES = {
    "Sphere": Sphere,
    "Box": Box,
    "Cylinder": Cylinder,
    "Cone": Cone,
    "Plane": Plane,
    "Superquadric": Superquadric,
    "Disk": Disk,
    "Arrow": Arrow,
    "Contour": lambda: Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0]),
    "Tetrahedra": lambda: Tetrahedralize(Input=Wavelet(WholeExtent=[-3, 3, -3, 3, -3, 3])),
}
# What a filter lacks by default, on all of these sources; "": nothing.
MISSING = {
    StreamingMeshSimplification: "",
    StreamingMeshSmoothing: "",
    StreamingDistance: "put a Mesh Region before this filter",
    StreamingBlend: "Patch must name the array",
    StreamingPoisson: "put a Mesh Condition before this filter",
    StreamingMeshDeformation: "put a Mesh Handle before this filter",
    StreamingMeshPreview: "use Streaming Mesh Simplification",
}


def expected_on(filter_of, name):
    if filter_of in (MeshRegion, MeshHandle, MeshCondition):
        return ""
    if filter_of is StreamingMeshSmoothing and name == "Tetrahedra":
        return "the positions of tetrahedra cannot be smoothed"
    return MISSING[filter_of]


def warnings_of(proxy):
    """What the filter warns of from now on."""
    warnings = []

    @calldata_type(VTK_STRING)
    def note(_filter, _event, text):
        warnings.append(text)

    t.client_object(proxy).AddObserver("WarningEvent", note)
    return warnings


def check(filter_of, name):
    source = SOURCES[name]()
    source.UpdatePipeline()
    made = filter_of(Input=source)
    warnings = warnings_of(made)
    made.UpdatePipeline()
    made.UpdatePropertyInformation()
    what = f"{made.SMProxy.GetXMLName()} on {name}"
    # What panels send by default is not said to have no effect.
    assert "has no effect" not in "".join(warnings), (what, warnings)
    error, expected = made.GetPropertyValue("Error"), expected_on(filter_of, name)
    points = made.GetDataInformation().GetNumberOfPoints()
    if expected:
        assert expected in error and points == 0, (what, error, points)
    else:
        assert not error and points > 0, (what, error, points)
    # No classes, no pieces of what comes as a whole.
    assert not re.search(r"vtk[A-Z]|Streaming[A-Z]|Mesh[A-Z]|Piece \d", error), (what, error)
    if filter_of is StreamingMeshSimplification:
        outcome = made.GetPropertyValue("Outcome")
        assert outcome.startswith("Nothing to simplify: Number Of Vertices is 100,000"), (what, outcome)
        solid = "of the surface of a solid of 343 points and 1,080 tetrahedra" in outcome
        assert solid == (name == "Tetrahedra"), outcome


for filter_of in (*MISSING, MeshRegion, MeshHandle, MeshCondition):
    for name in SOURCES:
        check(filter_of, name)

turned = MeshHandle(Input=Sphere(), RotationAngle=70.0)
warnings = warnings_of(turned)
turned.UpdatePipeline()
turned.Radius = 2.0
turned.UpdatePipeline()
assert len(warnings) == 1 and "Rotation Angle has no effect: set Motion to Similarity" in warnings[0], warnings
# A number out of its range is not taken for another one.
for filter_of, name, least in ((StreamingMeshSmoothing, "MemoryLimit", 1), (StreamingDistance, "MaximumPasses", 1),
                               (StreamingMeshSimplification, "MemoryLimit", 16), (MeshRegion, "Rings", 0)):
    made = filter_of(Input=Sphere(), **{name: least - 1})
    made.UpdatePipeline()
    made.UpdatePropertyInformation()
    error = made.GetPropertyValue("Error")
    assert error.startswith(f"{made.GetProperty(name).GetXMLLabel()} is {least - 1}: set it to "), error

# A preview is said to be one, by the reader and by regions on it.
reader = OpenDataFile(t.BUNNY)
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 2000
region = MeshRegion(Input=reader, Region="Everywhere")
region.UpdatePipeline()
for proxy, words in ((reader, "A preview: {} of 34,834 points."),
                     (region, "{0} points of the preview, which has {0} of 34,834 points.")):
    proxy.UpdatePropertyInformation()
    shown = f"{proxy.GetDataInformation().GetNumberOfPoints():,}"
    assert proxy.GetPropertyValue("Outcome") == words.format(shown), proxy.GetPropertyValue("Outcome")
reader.MaximumPointsInMemory = 2000000
region.UpdatePipeline()
for proxy, words in ((reader, "All 34,834 points."), (region, "34,834 points.")):
    proxy.UpdatePropertyInformation()
    assert proxy.GetPropertyValue("Outcome") == words, proxy.GetPropertyValue("Outcome")

# What fails behind other filters of a preview is said in words of the pipeline: its user knows no pieces.
reader.MaximumPointsInMemory = 1000
for before in (Clip(Input=reader), Decimate(Input=reader), Threshold(Input=reader, Scalars=["POINTS", "OriginalId"])):
    for filter_of in (StreamingMeshSmoothing, StreamingDistance, StreamingMeshSimplification, StreamingMeshPreview):
        made = filter_of(Input=before)
        if made.GetProperty("Solve"):
            made.Solve = "Full Mesh"
        made.UpdatePipeline()
        made.UpdatePropertyInformation()
        what = f"{made.SMProxy.GetXMLName()} behind {before.SMProxy.GetXMLName()}"
        for name in ("Error", "Outcome", "Estimate"):
            said = made.GetPropertyValue(name) if made.GetProperty(name) else ""
            assert not re.search(r"[Pp]iece \d", said or ""), (what, said)
        Delete(made)

# Every filter of the menu has an icon.
for name in ("MeshRegion", "MeshCondition", "MeshHandle", "StreamingPoisson", "StreamingMeshDeformation",
             "StreamingMeshSmoothing", "StreamingBlend", "StreamingDistance", "StreamingMeshArea",
             "StreamingMeshSimplification", "StreamingMeshPreview"):
    menu = servermanager.ProxyManager().GetPrototypeProxy("filters", name).GetHints()
    icon = menu.FindNestedElementByName("ShowInMenu").GetAttribute("icon")
    assert icon and icon.startswith(":/pqWidgets/Icons/pq"), name
print("passed")
