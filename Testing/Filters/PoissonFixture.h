// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkDoubleArray.h"
#include "vtkUnsignedCharArray.h"

namespace smg::testing
{

/** Makes the point arrays Mask and Values, which hold both ends in x at their positions. */
class vtkEndsFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkEndsFilter* New() { VTK_STANDARD_NEW_BODY(vtkEndsFilter); }
  vtkTypeMacro(vtkEndsFilter, vtkPassInputTypeAlgorithm);
  int Executions = 0;
  double Bad = 0.0;
  double Left = -2.5, Right = 2.5;

  bool isHeld(const double* point) const
  {
    return point[0] <= this->Left || point[0] >= this->Right;
  }

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    ++this->Executions;
    vtkPointSet* output = vtkPointSet::GetData(outputVector);
    output->ShallowCopy(vtkPointSet::GetData(inputVector[0]));
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName("Mask");
    vtkNew<vtkDoubleArray> values;
    values->SetName("Values");
    values->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double* point = output->GetPoint(i);
      mask->InsertNextValue(this->isHeld(point) ? 1 : 0);
      values->InsertNextTuple3(point[0] + this->Bad, point[1], point[2]);
    }
    output->GetPointData()->AddArray(mask);
    output->GetPointData()->AddArray(values);
    return 1;
  }
};

class VtkStreamingPoisson : public ::testing::Test
{
protected:
  VtkStreamingPoisson()
  {
    this->open(torus(60, 30, 0.2));
    this->Ends->SetInputConnection(this->Reader->GetOutputPort());
    this->prepare(this->Poisson);
  }

  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
  }

  void prepare(vtkStreamingPoisson* poisson)
  {
    poisson->SetInputConnection(this->Ends->GetOutputPort());
    poisson->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mask");
    poisson->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Values");
    poisson->SetNumberOfPieces(5);
    poisson->SetTolerance(1e-8);
    poisson->SetScratchDirectory(this->Folder.path().c_str());
  }

  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0)); }

  PieceUnion collectPieces(int pieces)
  {
    PieceUnion all;
    all.watched = "Solution";
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Poisson, piece, pieces));
      all.add(this->output(), piece);
    }
    return all;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkEndsFilter> Ends;
  vtkNew<vtkStreamingPoisson> Poisson;
};

} // namespace smg::testing
