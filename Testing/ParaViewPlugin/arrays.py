# SPDX-License-Identifier: BSD-3-Clause
"""No array property is ever set automatically, regardless of the active arrays of the input, and unsuitable
arrays are not offered."""

import sys

import smg_testing as t
from paraview.simple import *

LoadPlugin(sys.argv[1], ns=globals())
t.StreamingPoisson = StreamingPoisson


def check(source, when):
    for proxy in (StreamingPoisson(Input=source), MeshCondition(Input=source)):
        checked = 0
        for name in proxy.ListProperties():
            domain = proxy.GetProperty(name).SMProperty.FindDomain("vtkSMArrayListDomain")
            if domain:
                value = proxy.GetPropertyValue(name)
                chosen = value if isinstance(value, str) else list(value)[-1]
                assert chosen in ("None", "", None), (when, name, value)
                offered = {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}
                assert "None" in offered, (when, name, offered)
                unwanted = {"GlobalIds", "vtkGhostType", "StreamFinalized", "MeshConditions"}
                assert not offered & unwanted, (when, name, offered)
                checked += 1
        assert checked == (7 if proxy.SMProxy.GetXMLName() == "StreamingPoisson" else 2), checked


reader = OpenDataFile(t.BUNNY)
check(reader, "before an update")
reader.UpdatePipeline()
check(reader, "after an update")
calculators = t.make_problem(reader)
check(calculators, "behind two calculators")
calculators.UpdatePipeline()
check(calculators, "behind two calculators that were updated")
display = Show(calculators, CreateView("RenderView"))
ColorBy(display, ("POINTS", "Mask"))
check(calculators, "while it is coloured by another array")

check(MeshCondition(Input=calculators, Region="Everywhere"), "behind a condition")
reader.MaximumPointsInMemory, reader.PreviewPoints = 1000, 10000
reader.UpdatePipeline()
check(reader, "behind a preview")
# Its shading is that of the mesh.
assert Show(reader, GetActiveView()).SelectNormalArray == "Normals"
reader.MaximumPointsInMemory = 2000000

# A scan in millimetres, in a typical script: the harmonic field stays between its end values.
scaled = Transform(Input=reader)
scaled.Transform.Scale = [1000.0] * 3
scaled.UpdatePipeline()
poisson = t.make_poisson(t.make_problem(scaled, low=1000 * t.FEET, high=1000 * t.EARS))
poisson.UpdatePipeline()
values = t.points_of(poisson, "Solution")
poisson.UpdatePropertyInformation()
assert poisson.GetPropertyValue("Converged") == 1
for axis, (low, high) in enumerate(zip(*[iter(scaled.GetDataInformation().GetBounds())] * 2)):
    margin = 0.05 * (high - low)
    assert low - margin < values[:, axis].min() and values[:, axis].max() < high + margin, axis
print("passed")
