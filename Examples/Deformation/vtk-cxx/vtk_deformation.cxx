// SPDX-License-Identifier: BSD-3-Clause
/*
The Stanford bunny turns its head, out of core, in C++ with a VTK pipeline.

Its base is fixed, its head turned by 70 degrees and scaled by 1.3, an ear turned by 90 degrees; the
rest of the mesh follows and keeps its details.

What this lesson shows:
 1. A handle is a filter: vtkMeshHandle holds the points where an implicit function is at most 0,
    and stores their motion in point arrays. The filters are chained.
 2. vtkStreamingMeshDeformation requests the mesh with these arrays in pieces, solves on scratch
    files, and delivers any piece of the deformed mesh.
 3. vtkStreamingMeshWriter requests one piece after the other. The whole mesh is never in memory.

Run it:

    vtk_deformation ../../Data/bunny.smb bunny-deformed.vsm

    34834 points: converged in 11 passes, relative residual 8.73883e-08
*/

#include "vtkMeshHandle.h"
#include "vtkStreamingMeshDeformation.h"
#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMeshWriter.h"

#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkSphere.h"

#include <iostream>

namespace
{

/** Sets the region of the handle to a sphere. */
void holdSphere(vtkMeshHandle& handle, double x, double y, double z, double radius)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(x, y, z);
  sphere->SetRadius(radius);
  handle.SetRegionFunction(sphere);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: vtk_deformation BUNNY DEFORMED.vsm|.ply|.vtp|.vtu\n";
    return 2;
  }
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(argv[1]);

  // Lengths are in the unit of the mesh: the bunny is 15 cm high, y points up. The base is fixed.
  // The inside of a plane is the side opposite to its normal.
  vtkNew<vtkPlane> ground;
  ground->SetOrigin(0, 0.05, 0);
  ground->SetNormal(0, 1, 0);
  vtkNew<vtkMeshHandle> base;
  base->SetInputConnection(reader->GetOutputPort());
  base->SetRegionFunction(ground);

  // Rotation and scale about the centre, followed by the translation.
  vtkNew<vtkMeshHandle> head;
  head->SetInputConnection(base->GetOutputPort());
  holdSphere(*head, -0.068, 0.134, 0.027, 0.034);
  head->SetMotion(vtkMeshHandle::SIMILARITY);
  head->SetRotationAxis(0, 1, 0);
  head->SetRotationAngle(70);
  head->SetCenter(-0.065, 0.11, 0.01);
  head->SetScale(1.3);
  head->SetTranslation(-0.015, 0.012, 0.01);

  vtkNew<vtkMeshHandle> ear;
  ear->SetInputConnection(head->GetOutputPort());
  holdSphere(*ear, -0.068, 0.175, -0.055, 0.025);
  ear->SetMotion(vtkMeshHandle::SIMILARITY);
  ear->SetRotationAxis(-0.4, 0.8, 0.45);
  ear->SetRotationAngle(90);
  ear->SetCenter(-0.065, 0.152, -0.008);
  ear->SetScale(1.3);
  ear->SetTranslation(-0.037, 0.025, 0.02);

  vtkNew<vtkStreamingMeshDeformation> deformation;
  deformation->SetInputConnection(ear->GetOutputPort());
  deformation->SetMemoryLimit(128); // MiB

  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(deformation->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write())
  {
    // The filters have reported the error.
    return 1;
  }
  std::cout << reader->GetFullNumberOfPoints()
            << " points: " << (deformation->GetConverged() ? "converged" : "not converged")
            << " in " << deformation->GetPasses() << " passes, relative residual "
            << deformation->GetResidual() << "\n";
  return 0;
}
