// SPDX-License-Identifier: BSD-3-Clause
/*
Distances along the surface of the Stanford bunny from the tip of an ear, out of core, in C++ with a
VTK pipeline.

What this lesson shows:
 1. vtkStreamingDistance requests the mesh in pieces, marches a front through a window of it on
    scratch files, and delivers any piece of the mesh with its distances.
 2. From names a part of the mesh in the JSON of problem files. Without it, the sources are what a
    vtkMeshHandle before the filter holds.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_distances ../../Data/bunny.smb bunny-distance.vsm

    34834 points: settled in 1 pass
*/

#include "vtkStreamingDistance.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"

#include "vtkNew.h"

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_distances BUNNY DISTANCE.vsm|.ply|.vtp\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkStreamingDistance> distance;
  distance->SetInputConnection(reader->GetOutputPort());
  distance->SetFrom("{\"nearest\": [[-0.0175, 0.187, -0.02]]}");
  distance->SetMemoryLimit(128); // MiB

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(distance->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    // The filters have reported the error.
    return 1;
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (distance->GetConverged() ? "settled" : "not settled") << " in "
            << distance->GetPasses() << (distance->GetPasses() == 1 ? " pass" : " passes") << "\n";
  return 0;
}
