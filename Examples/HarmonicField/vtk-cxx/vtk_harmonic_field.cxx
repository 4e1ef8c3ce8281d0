// SPDX-License-Identifier: BSD-3-Clause
/*
A harmonic field on the Stanford bunny, out of core, in C++ with a VTK pipeline.

The field is 0 at the feet and 1 at the tips of the ears; in between it is harmonic: each value is
the weighted mean of its neighbours. The program writes the field's isolines as a .vtp file.

What this lesson shows:
 1. vtkStreamingMeshReader delivers any piece of a mesh stream; ordinary filters work on pieces.
 2. A problem is described by conditions in regions: a vtkMeshCondition prescribes a value in a
    region. The filters are chained.
 3. vtkStreamingPoisson requests the mesh in pieces, solves on scratch files, and delivers any piece
    with the solution. The isolines are extracted piece by piece; the whole mesh is never in memory.

Run it:

    vtk_harmonic_field ../../Data/bunny.smb isolines.vtp

    34834 points: converged after 6 cycles, relative residual 7.42985e-09
    isolines.vtp: 7379 segments
*/

#include "vtkMeshCondition.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingPoisson.h"

#include "vtkAppendPolyData.h"
#include "vtkContourFilter.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPlane.h"
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

  // y points up; the feet are below 3.6 cm, the tips of the ears above 18 cm. The inside of a plane
  // is the side opposite to its normal.
  vtkNew<vtkPlane> low;
  low->SetOrigin(0.0, 0.036, 0.0);
  low->SetNormal(0.0, 1.0, 0.0);
  vtkNew<vtkMeshCondition> feet;
  feet->SetInputConnection(reader->GetOutputPort());
  feet->SetRegionFunction(low);
  feet->SetValue(0.0);
  vtkNew<vtkPlane> high;
  high->SetOrigin(0.0, 0.18, 0.0);
  high->SetNormal(0.0, -1.0, 0.0);
  vtkNew<vtkMeshCondition> ears;
  ears->SetInputConnection(feet->GetOutputPort());
  ears->SetRegionFunction(high);
  ears->SetValue(1.0);

  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetInputConnection(ears->GetOutputPort());
  poisson->SetMemoryLimit(64);

  constexpr int bands = 24;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(poisson->GetOutputPort());
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Solution");
  for (int band = 1; band < bands; ++band)
  {
    contour->SetValue(band - 1, double(band) / bands);
  }

  // The first piece executes the solve; the others use its solution.
  constexpr int pieces = 16;
  vtkNew<vtkAppendPolyData> isolines;
  for (int piece = 0; piece < pieces; ++piece)
  {
    contour->UpdatePiece(piece, pieces, 0);
    if (!*poisson->GetReport())
    {
      // The filter has reported the error.
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
  // With recent versions of Expat many VTK readers reject appended data, the default.
  writer->SetDataModeToBinary();
  if (!writer->Write())
  {
    return 1;
  }
  std::cout << argv[2] << ": " << isolines->GetOutput()->GetNumberOfLines() << " segments\n";
  return 0;
}
