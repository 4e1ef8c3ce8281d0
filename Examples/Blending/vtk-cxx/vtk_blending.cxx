// SPDX-License-Identifier: BSD-3-Clause
/*
The light on the Stanford bunny, recorded in four scans of different brightness, becomes seamless,
out of core, in C++ with a VTK pipeline.

Scans of a real object have such arrays in their file; here two vtkArrayCalculators compute them,
piece by piece.

What this lesson shows:
 1. Filters of VTK that pass points and cells on may stand between the reader and the blend.
 2. vtkStreamingBlend requests the mesh in pieces, removes the steps of the light between the scans
on scratch files, and delivers any piece of the blended mesh.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_blending ../../Data/bunny.smb bunny-blended.vsm

    34834 points: converged in 9 passes
*/

#include "vtkStreamingBlend.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"

#include "vtkArrayCalculator.h"
#include "vtkNew.h"

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_blending BUNNY BLENDED.vsm|.ply|.vtp\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkArrayCalculator> scan;
  scan->SetInputConnection(reader->GetOutputPort());
  scan->SetAttributeTypeToPointData();
  scan->AddCoordinateScalarVariable("x", 0);
  scan->AddCoordinateScalarVariable("y", 1);
  scan->SetFunction("(x > -0.02) + 2 * (y > 0.1)");
  scan->SetResultArrayName("Scan");

  vtkNew<vtkArrayCalculator> light;
  light->SetInputConnection(scan->GetOutputPort());
  light->SetAttributeTypeToPointData();
  light->AddCoordinateScalarVariable("z", 2);
  light->AddScalarVariable("scan", "Scan");
  light->SetFunction("128 + 512 * z + 32 * scan");
  light->SetResultArrayName("Light");

  vtkNew<vtkStreamingBlend> blend;
  blend->SetInputConnection(light->GetOutputPort());
  blend->SetPatch("Scan");
  blend->AddColumn("Light");
  blend->SetMemoryLimit(128); // MiB

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(blend->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    // The filters have reported the error.
    return 1;
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (blend->GetConverged() ? "converged" : "not converged") << " in "
            << blend->GetPasses() << " passes\n";
  return 0;
}
