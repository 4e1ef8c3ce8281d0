# SPDX-License-Identifier: BSD-3-Clause
"""States and traces in Python hold the selection of a region: their scripts make the same region.

traces.py PLUGIN"""

import sys

import numpy as np

import smg_testing as t
from paraview import servermanager, smstate, smtrace
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
sphere = Sphere(ThetaResolution=20, PhiResolution=14, registrationName="Ball")
view = GetActiveViewOrCreate("RenderView")
Show(sphere, view)
Render()
FILTERS = {MeshRegion: "RegionMask", MeshHandle: "HandleMask", MeshCondition: "Condition1"}


def by_rectangle(select):
    SetActiveSource(sphere)
    select(Rectangle=[100, 100, 250, 200], View=view)
    return sphere.GetSelectionInput(0)


SELECTIONS = {
    "points": lambda: by_rectangle(SelectSurfacePoints),
    "cells": lambda: by_rectangle(SelectSurfaceCells),
    "registered": lambda: IDSelectionSource(FieldType="POINT", IDs=[0, 3, 0, 8]),
}


def marks(region, name):
    return t.points_of(region, name)[:, 0]


def again(script):
    """Runs a script of ParaView: its variables."""
    names = dict(globals())  # a filter of a plugin is no name of paraview.simple
    exec(compile(script, "script", "exec"), names)
    return names


for make, array in FILTERS.items():
    for name, select in SELECTIONS.items():
        selection = select()
        region = make(Input=sphere, Region="Selection", Selection=selection, registrationName="Marked")
        expected = marks(region, array)
        assert 0 < np.count_nonzero(expected != expected[-1]) < len(expected), (make, name)
        assert smstate.get_state()
        state = smstate.get_state(filter=lambda proxy: proxy and proxy.SMProxy.IsA("vtkSMSourceProxy"))
        # A trace from the start, and one of what a panel applies, of the region and others together.
        smtrace.start_trace(preamble="from paraview.simple import *")
        smtrace.RegisterPipelineProxy(region).finalize()
        made = smtrace.stop_trace()
        region.Region, region.Selection = "Everywhere", None
        smtrace.start_trace(preamble="from paraview.simple import *")
        modified = smtrace.PropertiesModified(region)
        region.Region, region.Selection = "Selection", selection
        modified.finalize()
        applied = smtrace.stop_trace()
        for script in (state, made, applied):
            assert ("servermanager." in script) == (name != "registered"), script
            assert name == "registered" or script.count("IDSelectionSource(") <= 1, script
        sources = len(GetSources())
        region.Region, region.Selection = "Everywhere", None
        SetActiveSource(region)
        again(applied)
        assert region.Region == "Selection" and np.array_equal(marks(region, array), expected), (make, name)
        assert len(GetSources()) == sources
        for script in (made, state):
            before = dict(GetSources())
            repeated = again(script)["marked"]
            assert repeated.SMProxy != region.SMProxy and repeated.Region == "Selection"
            assert np.array_equal(marks(repeated, array), expected), (make, name)
            for key, proxy in list(GetSources().items()):
                if key not in before:
                    Delete(proxy)
        Delete(region)
        if name == "registered":
            Delete(selection)
        else:
            ClearSelection(sphere)

# Of a selection that the region does not take, too.
SetActiveSource(sphere)
QuerySelect(QueryString="Normals_Z > 0.5", FieldType="POINT", Source=sphere)
queried = MeshRegion(Input=sphere, Region="Selection", Selection=sphere.GetSelectionInput(0))
script = smstate.get_state()
assert "servermanager.sources.SelectionQuerySource(" in script and "'Normals_Z > 0.5'" in script, script
Delete(queried)

# Without its selection, the region of a script fails with a sentence.
empty = MeshRegion(Input=sphere, Region="Selection")
script = smstate.get_state()
assert "Region = 'Selection'" in script, script
with t.Silence():
    empty.UpdatePipeline()
empty.UpdatePropertyInformation()
assert "selection" in empty.GetPropertyValue("Error"), empty.GetPropertyValue("Error")
print("passed")
