# SPDX-License-Identifier: BSD-3-Clause
"""The wrapped classes in a plain Python, without ParaView's client."""

import os

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkArrayCalculator
from streamingmultigrid.vtk import (
    vtkStreamingMeshKeys, vtkStreamingMeshReader, vtkStreamingPoisson)

reader = vtkStreamingMeshReader()
reader.SetFileName(os.path.join(os.environ["SMG_SOURCE_DIR"], "Examples", "Data", "bunny.smb"))
previous = reader
for name, function in (("Mask", "(y < 0.04) | (y > 0.17)"), ("Values", "y")):
    calculator = vtkArrayCalculator()
    calculator.SetInputConnection(previous.GetOutputPort())
    calculator.AddCoordinateScalarVariable("y", 1)
    calculator.SetFunction(function)
    calculator.SetResultArrayName(name)
    previous = calculator
poisson = vtkStreamingPoisson()
poisson.SetInputConnection(previous.GetOutputPort())
points = vtkDataObject.FIELD_ASSOCIATION_POINTS
poisson.SetInputArrayToProcess(0, 0, 0, points, "Mask")
poisson.SetInputArrayToProcess(1, 0, 0, points, "Values")
poisson.Update()
assert poisson.GetConverged() == 1 and poisson.GetResidual() < 1e-6
assert poisson.GetOutput().GetPointData().GetArray("Solution").GetNumberOfTuples() == 34834
poisson.GetOutputInformation(0).Set(vtkStreamingMeshKeys.STREAMED(), 3)
poisson.UpdatePiece(1, 3, 0)
assert vtkStreamingMeshKeys.IsStreamed(poisson.GetOutputInformation(0))
print("passed:", poisson.GetOutput().GetNumberOfPoints(), "points in piece 1 of 3")
