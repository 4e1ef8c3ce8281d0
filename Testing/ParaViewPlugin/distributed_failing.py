# SPDX-License-Identifier: BSD-3-Clause
"""What the distributed engine refuses in one process is one error in all, and none keeps waiting."""

import json
import os
import sys

import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController, vtkOutputWindow, vtkStringOutputWindow
from streamingmultigrid.vtk import vtkStreamingMultigridFilters  # the methods of the filter

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1


def refuse(source, sentence, **properties):
    """Solving fails in every process with this sentence."""
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)
    poisson = StreamingPoisson(Input=source, Engine="Distributed", **properties)
    poisson.UpdatePipeline()
    solver = t.client_object(poisson)
    text = messages.GetOutput()
    vtkOutputWindow.SetInstance(None)
    assert solver.GetOutputDataObject(0).GetNumberOfPoints() == 0
    # Process 0 says it for all.
    assert text.count(sentence) == text.count("ERROR") + text.count("ERR|") == (rank == 0), text
    assert solver.GetConverged() == 0 and sentence in solver.GetOutcome(), solver.GetOutcome()


def changed(source, code):
    """The input, changed by the last process."""
    script = f"output.ShallowCopy(inputs[0].VTKObject)\nif {rank} == {ranks - 1}:\n    {code}"
    return ProgrammableFilter(Input=source, Script=script, CopyArrays=1)


reader = OpenDataFile(t.BUNNY)
posed = json.dumps({"screening": 1, "source": 1})
refuse(changed(reader, "output.VTKObject.GetPointData().SetGlobalIds(None);"
                       " output.VTKObject.GetPointData().RemoveArray('GlobalIds')"),
       "apply the filter Generate Global Ids", Problem=posed)
refuse(changed(reader, "points = output.VTKObject.GetPoints();"
                       " copy = points.NewInstance(); copy.DeepCopy(points);"
                       " copy.SetPoint(7, float('nan'), 0, 0); output.VTKObject.SetPoints(copy)"),
       "not a finite number", Problem=posed)
refuse(changed(reader, "output.VTKObject.GetPolys().Reset(); output.VTKObject.Modified()"),
       "belongs to no cell", Problem=posed)
refuse(RedistributeDataSet(Input=reader, BoundaryMode="Assign to all regions"),
       "belong to several processes", Problem=posed)
refuse(changed(reader, "points = output.VTKObject.GetPoints(); copy = points.NewInstance();"
                       " copy.DeepCopy(points); x, y, z = copy.GetPoint(0);"
                       " copy.SetPoint(0, x + 1, y, z); output.VTKObject.SetPoints(copy)"),
       "the position of vertex", Problem=posed)
refuse(reader, "Nothing says what to solve")
refuse(reader, "do not have the same problem",
       Problem=json.dumps({"screening": 1 if rank < ranks - 1 else 2, "source": 1}))
preview = OpenDataFile(t.BUNNY)
preview.MaximumPointsInMemory, preview.PreviewPoints = 0, 10000
refuse(preview, "is a preview of the mesh", Problem=posed)
refuse(reader, "no checkpoints", Problem=posed, CheckpointDirectory=t.make_shared_folder())

# No messages between the processes remain.
poisson = StreamingPoisson(Input=reader, Engine="Distributed", Problem=posed)
poisson.UpdatePipeline()
assert t.client_object(poisson).GetConverged() == 1
# One step is not enough.
messages = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(messages)
poisson.MaximumCycles, poisson.Tolerance, poisson.Screening = 1, 1e-12, 3
poisson.UpdatePipeline()
vtkOutputWindow.SetInstance(None)
solver = t.client_object(poisson)
assert messages.GetOutput().count("did not converge") == (rank == 0), messages.GetOutput()
assert solver.GetConverged() == 0 and solver.GetOutputDataObject(0).GetNumberOfPoints() > 0
controller.Barrier()
os.write(1, f"passed in process {rank}\n".encode())
