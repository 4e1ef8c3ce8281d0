# SPDX-License-Identifier: BSD-3-Clause
"""A view of a preview says how much of the mesh it shows, in pictures, too, and nothing else does."""

import os
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk.vtkIOImage import vtkPNGReader

folder = t.make_folder()


def view_of(*sources):
    view = CreateView("RenderView")
    view.ViewSize = [600, 400]
    for source in sources:
        Show(source, view)
    ResetCamera(view)
    return view


def text_of(view):
    """The text of a view after it has been rendered; empty: none is visible."""
    Render(view)
    hidden = view.SMProxy.GetProperty("HiddenRepresentations")
    texts = []
    for k in range(hidden.GetNumberOfProxies()):
        proxy = hidden.GetProxy(k)
        if proxy.GetProperty("Text") and proxy.GetProperty("Visibility").GetElement(0):
            texts.append(proxy.GetProperty("Text").GetElement(0))
    assert len(texts) < 2, texts
    return texts[0] if texts else ""


def lower_edge(view, name):
    """The pixels of a picture where the text is."""
    path = os.path.join(folder, name)
    SaveScreenshot(path, view, ImageResolution=view.ViewSize)
    file = vtkPNGReader()
    file.SetFileName(path)
    file.Update()
    pixels = t.vtk_to_numpy(file.GetOutput().GetPointData().GetScalars()).reshape(400, 600, -1)
    return pixels[:30, 200:-200]


early = view_of(Sphere())
LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson
reader = StreamingMeshReader(FileName=t.BUNNY, MaximumPointsInMemory=1000, PreviewPoints=10000)
reader.UpdatePipeline()
shown = reader.GetDataInformation().GetNumberOfPoints()
PREVIEW = f"{shown:,} of {t.BUNNY_POINTS:,} points"
reader.UpdatePropertyInformation()
assert PREVIEW in reader.GetPropertyValue("Outcome"), reader.GetPropertyValue("Outcome")

view = view_of(reader)
assert text_of(view) == PREVIEW
with_text = lower_edge(view, "preview.png")
assert text_of(early) == ""
Show(reader, early)
assert text_of(early) == PREVIEW  # of a view that is older than the plugin

# What is made of a preview shows no more of the mesh: a slice has fewer points than that.
for made in (Calculator(Input=reader, Function="coordsX"), Slice(Input=reader), t.make_poisson(t.make_problem(reader)),
             StreamingMeshPreview(Input=reader, PreviewPoints=10000)):
    assert text_of(view_of(made)) == PREVIEW, made
# Of two meshes it has two lines, of two displays of one mesh one.
other = StreamingMeshReader(FileName=t.BUNNY, MaximumPointsInMemory=1000, PreviewPoints=5000)
assert sorted(text_of(view_of(reader, other, Slice(Input=reader))).split("\n")) == sorted(
    [PREVIEW, f"{other.GetDataInformation().GetNumberOfPoints():,} of {t.BUNNY_POINTS:,} points"])

# It goes with the preview: hidden, or when all of the mesh is shown.
Hide(reader, view)
assert text_of(view) == ""
Show(reader, view)
assert text_of(view) == PREVIEW
reader.MaximumPointsInMemory = 2000000
assert text_of(view) == ""
without = lower_edge(view, "whole.png")
assert (with_text != without).any() and (without == without[0, 0]).all()
reader.MaximumPointsInMemory = 1000
assert text_of(view) == PREVIEW

# It is neither in the pipeline nor in a state, of which a new session makes it anew.
names = {name for name, _ in GetSources()}
assert not any("Text" in name for name in names), names
state = os.path.join(folder, "state.pvsm")
SaveState(state)
with open(state, encoding="utf-8") as file:
    assert "TextWidget" not in file.read()
Delete(view)
ResetSession()
LoadState(state)
assert any(text_of(each) == PREVIEW for each in GetViews())
print("passed")
