# SPDX-License-Identifier: BSD-3-Clause
"""An input that fails in one process fails in all, and no process keeps waiting."""

import os
import sys

import deformation_testing as d
import smg_testing as t
from paraview.simple import *
from paraview.vtk import vtkMultiProcessController, vtkOutputWindow, vtkStringOutputWindow

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
assert ranks > 1

# The last process reads the damage; the others learn of it during communication.
path = os.path.join(t.make_shared_folder(), "damaged.vsm")
SaveData(path, proxy=OpenDataFile(t.BUNNY))
if rank == 0:
    with open(path, "r+b") as file:
        file.seek(int(0.85 * os.path.getsize(path)))
        file.write(b"damage" * 20)
controller.Barrier()

reader = StreamingMeshReader(FileName=path)
for first, make in ((True, lambda: StreamingMeshDeformation(Input=d.make_handles(reader, MeshHandle))),
                    (False, lambda: t.make_poisson(t.make_problem(reader)))):
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)
    failing = make()
    for attempt in range(2):
        failing.UpdatePipeline()
        assert t.client_object(failing).GetOutputDataObject(0).GetNumberOfPoints() == 0
    text = messages.GetOutput()
    vtkOutputWindow.SetInstance(None)
    assert ("Another process failed" in text) == (rank < ranks - 1), text
    # The reader has not changed since, and reports the error once.
    assert text.count("checksum") == (1 if first and rank == ranks - 1 else 0), text

# No messages between the processes remain.
whole = StreamingMeshDeformation(Input=d.make_handles(OpenDataFile(t.BUNNY), MeshHandle))
whole.UpdatePipeline()
assert t.client_object(whole).GetOutputDataObject(0).GetNumberOfPoints() > 0
controller.Barrier()
os.write(1, f"passed in process {rank}\n".encode())
