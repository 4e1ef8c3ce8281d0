# SPDX-License-Identifier: BSD-3-Clause
"""A pvpython client and a pvserver, both with the plugin."""

import os
import shutil
import subprocess
import sys

import deformation_testing as d
import smg_testing as t
from paraview.simple import *

port = 11000 + os.getpid() % 20000
folder = t.make_folder()
server = subprocess.Popen([sys.argv[2], f"--server-port={port}"], stdout=subprocess.PIPE, text=True,
                          env={**os.environ, "TMPDIR": folder})
try:
    for line in server.stdout:
        if "Accepting connection" in line:
            break
    Connect("127.0.0.1", port)
    LoadPlugin(sys.argv[1], remote=True, ns=globals())
    LoadPlugin(sys.argv[1], remote=False, ns=globals())
    t.StreamingPoisson = StreamingPoisson

    reader = OpenDataFile(t.BUNNY)
    poisson = t.make_poisson(t.make_problem(reader))
    poisson.UpdatePipeline()
    poisson.UpdatePropertyInformation()
    assert poisson.GetPropertyValue("Converged") == 1
    assert poisson.GetPropertyValue("Residual") < 1e-6
    assert poisson.GetPropertyValue("Report").startswith("{")
    assert poisson.GetDataInformation().GetNumberOfCells() == t.BUNNY_CELLS
    assert poisson.PointData["Solution"].GetNumberOfComponents() == 3

    view = CreateRenderView()
    representation = Show(poisson, view)
    ColorBy(representation, ("POINTS", "Solution"))
    Render(view)
    path = os.path.join(folder, "solved.vsm")
    SaveData(path, proxy=poisson)
    assert os.path.getsize(path) > 500000

    # Handles and a deformation of the preview; the saved file holds the whole mesh.
    reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
    handles = d.make_handles(reader, MeshHandle)
    deformation = StreamingMeshDeformation(Input=handles)
    deformation.UpdatePipeline()
    assert 500 < deformation.GetDataInformation().GetNumberOfPoints() < t.BUNNY_POINTS
    before = deformation.GetDataInformation().GetBounds()
    handles.RotationAngle = 10.0
    deformation.UpdatePipeline()
    assert deformation.GetDataInformation().GetBounds() != before
    deformation.UpdatePropertyInformation()
    assert deformation.GetPropertyValue("NumberOfBuilds") == 1
    path = os.path.join(folder, "deformed.vsm")
    SaveData(path, proxy=deformation)
    deformed = StreamingMeshReader(FileName=path)
    deformed.UpdatePipeline()
    assert deformed.GetDataInformation().GetNumberOfPoints() == t.BUNNY_POINTS
    print("passed", flush=True)
finally:
    server.kill()
shutil.rmtree(folder, ignore_errors=True)
# At exit ParaView would notify the server, which has ended.
os._exit(0)
