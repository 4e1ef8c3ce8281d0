# SPDX-License-Identifier: BSD-3-Clause
"""A pvpython client and two processes of pvserver, which solve together."""

import json
import os
import shutil
import subprocess
import sys

import numpy
import smg_testing as t
from paraview.simple import *

port = 11000 + os.getpid() % 20000
folder = t.make_folder()
plugin, mpiexec, pvserver = sys.argv[1:]
if not os.path.exists(mpiexec):
    t.skip("mpiexec is not installed")
# pvpython is an MPI program of one process itself, to which its environment would attach mpiexec.
environment = {name: value for name, value in os.environ.items()
               if not name.startswith(("OMPI_", "PMIX_"))}
server = subprocess.Popen([mpiexec, "-n", "2", "--allow-run-as-root", "--oversubscribe", "--mca",
                           "mpi_yield_when_idle", "1", pvserver,
                           f"--server-port={port}"], stdout=subprocess.PIPE, text=True,
                          env={**environment, "TMPDIR": folder})
try:
    for line in server.stdout:
        print(line, end="", flush=True)
        if "Accepting connection" in line:
            break
    Connect("127.0.0.1", port)
    LoadPlugin(plugin, remote=True, ns=globals())
    LoadPlugin(plugin, remote=False, ns=globals())
    t.StreamingPoisson = StreamingPoisson

    reader = OpenDataFile(t.BUNNY)
    poisson = t.make_poisson(t.make_problem(reader))
    poisson.Tolerance = 1e-10
    solutions = {}
    for engine in "Streaming", "Distributed":
        poisson.Engine = engine
        poisson.UpdatePipeline()
        poisson.UpdatePropertyInformation()
        assert poisson.GetPropertyValue("Converged") == 1, poisson.GetPropertyValue("Outcome")
        report = json.loads(poisson.GetPropertyValue("Report"))
        assert ("distributed" in report) == (engine == "Distributed")
        data = servermanager.Fetch(poisson)
        ids = t.vtk_to_numpy(data.GetPointData().GetArray("GlobalIds"))
        solutions[engine] = numpy.full((t.BUNNY_POINTS, 3), numpy.nan)
        solutions[engine][ids] = t.vtk_to_numpy(data.GetPointData().GetArray("Solution"))
    assert report["distributed"]["processes"] == 2
    assert "on 2 processes" in poisson.GetPropertyValue("Outcome")
    streamed = solutions["Streaming"]
    assert not numpy.isnan(streamed).any()
    assert abs(solutions["Distributed"] - streamed).max() <= 1e-6 * numpy.ptp(streamed)

    # A view shows it, without another solve.
    view = CreateRenderView()
    ColorBy(Show(poisson, view), ("POINTS", "Solution"))
    Render(view)
    poisson.UpdatePropertyInformation()
    assert json.loads(poisson.GetPropertyValue("Report")) == report
    print("passed", flush=True)
finally:
    server.kill()
shutil.rmtree(folder, ignore_errors=True)
# At exit ParaView would notify the server, which has ended.
os._exit(0)
