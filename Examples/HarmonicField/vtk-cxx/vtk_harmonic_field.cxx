// SPDX-License-Identifier: BSD-3-Clause
/*
A harmonic field on the Stanford bunny, out of core, in C++ with a VTK pipeline.

The field is 0 at the feet and 1 at the tips of the ears; in between it is harmonic: each value is
the weighted mean of its neighbours. The program writes the field's isolines as a .vtp file.

What this lesson shows:
 1. vtkStreamingMeshReader delivers any piece of a mesh stream; ordinary filters work on pieces.
 2. The problem is stated with point arrays: a mask of the points that are held, and values there.
    Calculators can make them, since they pass on GlobalIds and the other arrays of a piece.
 3. vtkStreamingPoisson pulls the mesh in pieces, solves on scratch files, and serves the solution
    with any piece. The isolines are extracted piece by piece, so never is the whole mesh in memory.

Run it:

    vtk_harmonic_field ../../Data/bunny.smb isolines.vtp

    34834 points: converged after 7 cycles, relative residual 2.96394e-07
    isolines.vtp: 7388 segments
*/

#include "vtkStreamingMeshReader.h"
#include "vtkStreamingPoisson.h"

#include "vtkAppendPolyData.h"
#include "vtkArrayCalculator.h"
#include "vtkContourFilter.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_harmonic_field MESH ISOLINES.vtp\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  // y points up; the feet are below 3.6 cm, the tips of the ears above 18 cm.
  vtkNew<vtkArrayCalculator> held;
  held->SetInputConnection(reader->GetOutputPort());
  held->SetAttributeTypeToPointData();
  held->AddCoordinateScalarVariable("y", 1);
  held->SetFunction("(y < 0.036) | (y > 0.18)");
  held->SetResultArrayName("Held");
  vtkNew<vtkArrayCalculator> values;
  values->SetInputConnection(held->GetOutputPort());
  values->SetAttributeTypeToPointData();
  values->AddCoordinateScalarVariable("y", 1);
  values->SetFunction("y > 0.18");
  values->SetResultArrayName("Temperature");

  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetInputConnection(values->GetOutputPort());
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  poisson->SetInputArrayToProcess(0, 0, 0, points, "Held");
  poisson->SetInputArrayToProcess(1, 0, 0, points, "Temperature");
  poisson->SetMemoryLimit(64);

  constexpr int bands = 24;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(poisson->GetOutputPort());
  contour->SetInputArrayToProcess(0, 0, 0, points, "Solution");
  for (int band = 1; band < bands; ++band)
  {
    contour->SetValue(band - 1, double(band) / bands);
  }

  // The first piece lets the filter solve; the others find the solution there.
  constexpr int pieces = 16;
  vtkNew<vtkAppendPolyData> isolines;
  for (int piece = 0; piece < pieces; ++piece)
  {
    contour->UpdatePiece(piece, pieces, 0);
    if (!*poisson->GetReport())
    {
      // The filter has said why it could not solve.
      return 1;
    }
    vtkNew<vtkPolyData> lines;
    lines->ShallowCopy(contour->GetOutput());
    isolines->AddInputData(lines);
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (poisson->GetConverged() ? "converged" : "not converged") << " after "
            << poisson->GetCycles() << " cycles, relative residual " << poisson->GetResidual()
            << "\n";

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(isolines->GetOutputPort());
  writer->SetFileName(argv[2]);
  // With recent versions of Expat many of VTK's readers refuse appended data, the default.
  writer->SetDataModeToBinary();
  if (!writer->Write())
  {
    return 1;
  }
  std::cout << argv[2] << ": " << isolines->GetOutput()->GetNumberOfLines() << " segments\n";
  return 0;
}
