// SPDX-License-Identifier: BSD-3-Clause
/*
The Stanford bunny becomes smooth except for its head, out of core, in C++ with a VTK pipeline.

The fur is a detail of a few millimetres: two implicit steps halve waves of 1 cm. The head is held.

What this lesson shows:
 1. vtkStreamingMeshSmoothing requests the mesh in pieces, takes its steps on scratch files, and
    delivers any piece of the smoothed mesh.
 2. Hold names the parts that do not move in the JSON of problem files. A chain of vtkMeshHandle
    before the filter can select them, too: {"mask": "HandleMask"}.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_smoothing ../../Data/bunny.smb bunny-smooth.vsm

    34834 points: converged in 18 passes, relative residual 4.20471e-10
*/

#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshSmoothing.h"
#include "vtkStreamingMeshWriter.h"

#include "vtkNew.h"

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_smoothing BUNNY SMOOTH.vsm|.ply|.vtp\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkStreamingMeshSmoothing> smoothing;
  smoothing->SetInputConnection(reader->GetOutputPort());
  smoothing->SetSizeUnit(vtkStreamingMeshSmoothing::MESH_UNIT);
  smoothing->SetSize(0.01); // the unit of the bunny is 1 m
  smoothing->SetSteps(2);
  smoothing->SetHold(R"({"sphere": [-0.07, 0.14, 0.01, 0.04]})");
  smoothing->SetMemoryLimit(128); // MiB

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(smoothing->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    // The filters have reported the error.
    return 1;
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (smoothing->GetConverged() ? "converged" : "not converged") << " in "
            << smoothing->GetPasses() << " passes, relative residual " << smoothing->GetResidual()
            << "\n";
  return 0;
}
