// SPDX-License-Identifier: BSD-3-Clause
// Links and runs classes of both installed VTK modules.

#include <vtkNew.h>
#include <vtkStreamingMeshReader.h>
#include <vtkStreamingPoisson.h>

#include <iostream>

int main()
{
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName("mesh.vsm");
  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetInputConnection(reader->GetOutputPort());
  poisson->Print(std::cout);
  return poisson->GetNumberOfInputConnections(0) == 1 ? 0 : 1;
}
