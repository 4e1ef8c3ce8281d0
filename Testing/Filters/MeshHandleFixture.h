// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkMeshHandle.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkSphere.h"

#include <algorithm>

namespace smg::testing
{

/** A handle on a torus, whose region is a ball. */
class VtkMeshHandle : public ::testing::Test
{
protected:
  VtkMeshHandle()
  {
    this->open(torus(60, 30, 0.2));
    this->Ball->SetCenter(2.0, 0.0, 0.0);
    this->Ball->SetRadius(1.2);
    this->prepare(this->Handle, this->Reader);
  }

  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
  }

  void prepare(vtkMeshHandle* handle, vtkAlgorithm* input)
  {
    handle->SetInputConnection(input->GetOutputPort());
    handle->SetRegionFunction(this->Ball);
  }

  const double* positionOf(std::int64_t vertex) const
  {
    return this->Mesh.positions.data() + 3 * vertex;
  }

  bool isInBall(std::int64_t vertex) const
  {
    double point[3];
    std::copy_n(this->positionOf(vertex), 3, point);
    return this->Ball->FunctionValue(point) <= 0.0;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkSphere> Ball;
  vtkNew<vtkMeshHandle> Handle;
};

} // namespace smg::testing
