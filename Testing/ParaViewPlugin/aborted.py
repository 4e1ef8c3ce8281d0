# SPDX-License-Identifier: BSD-3-Clause
"""A filter that is aborted, by itself or by the algorithm that it is a part of, ends without a result and works when
it is executed again."""

import os
import sys

import smg_testing as t
from paraview.vtk.vtkFiltersSources import vtkSphereSource
from streamingmultigrid.vtk import vtkStreamingDistance, vtkStreamingMeshSmoothing, vtkStreamingMeshWriter, vtkStreamingPoisson

NORTH = '[{"halfspace": [0, 0, 1, 0.45]}]'
FILTERS = ((vtkStreamingDistance, "SetFrom", NORTH), (vtkStreamingMeshSmoothing, "SetHold", NORTH),
           (vtkStreamingPoisson, "SetProblem", '{"dirichlet": [{"halfspace": [0, 0, 1, 0.45], "value": 1}], "source": 1}'))


def by_itself(made):
    return lambda: made.SetAbortExecute(1), lambda: made.SetAbortExecute(0)


def by_its_container(made):
    whole = vtkSphereSource()

    def abort():
        made.SetContainerAlgorithm(whole)
        whole.SetAbortExecuteAndUpdateTime()

    def end():
        made.SetContainerAlgorithm(None)

    return abort, end


scratch, saved = t.make_folder(), t.make_folder()
for make, setter, text in FILTERS:
    for way in (by_itself, by_its_container):
        sphere = vtkSphereSource()
        sphere.SetThetaResolution(60)
        sphere.SetPhiResolution(60)
        made = make()
        getattr(made, setter)(text)
        made.SetScratchDirectory(scratch)
        made.SetInputConnection(sphere.GetOutputPort())
        abort, end = way(made)
        calls = []
        made.AddObserver("ProgressEvent", lambda *_: calls or calls.append(abort()))
        failed = []
        made.AddObserver("ErrorEvent", lambda *_: failed.append(True))
        made.Update()
        assert calls, (make, way)
        assert made.GetOutput().GetNumberOfPoints() == 0, (make, way)
        assert os.listdir(scratch) == [], (make, way, os.listdir(scratch))
        writer = vtkStreamingMeshWriter()
        writer.SetInputConnection(made.GetOutputPort())
        writer.SetFileName(os.path.join(saved, "aborted.vsm"))
        writer.AddObserver("ErrorEvent", lambda *_: failed.append(True))
        end()
        made.Modified()
        calls.clear()
        failed.clear()
        writer.Write()
        # A save that is aborted reports no error, and leaves no file.
        assert calls and not failed and os.listdir(saved) == [], (make, way, failed)
        end()
        failed.clear()
        made.Modified()  # else the aborted work is not repeated
        made.Update()
        assert made.GetOutput().GetNumberOfPoints() > 0 and not failed, (make, way)
        del made, writer
print("passed")
