// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshHandle.h"
#include "Filters/vtkStreamingMeshPreview.h"
#include "Filters/vtkStreamingPoisson.h"
#include "Testing/Filters/vtkDeformationFixture.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <vector>

namespace smg::testing
{
namespace
{

/** Meshes that no filter can process. */
class VtkMeshInput : public DeformationFixture
{
protected:
  VtkMeshInput()
  {
    this->Handle->SetRegionFunction(this->Ball);
    updatePiece(this->Handles, 0, 1);
    this->Held->DeepCopy(this->Handles->GetOutputDataObject(0));
  }

  void expectError(vtkAlgorithm* filter, vtkDataObject* input, const std::string& words)
  {
    Errors errors(filter);
    filter->SetInputDataObject(input);
    updatePiece(filter, 0, 1);
    EXPECT_TRUE(errors.contain(words)) << filter->GetClassName() << ": " << errors.text();
  }

  vtkNew<vtkSphere> Ball;
  vtkNew<vtkPolyData> Held; ///< the mesh with the arrays of its handles
  vtkNew<vtkMeshHandle> Handle;
  vtkNew<vtkStreamingPoisson> Poisson;
  vtkNew<vtkStreamingMeshPreview> Preview;
};

TEST_F(VtkMeshInput, OfSeveralBlocksIsRefused)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, this->Held);
  blocks->SetBlock(1, this->Held);
  const std::vector<vtkAlgorithm*> filters{ this->Handle, this->Deformation, this->Poisson,
    this->Preview };
  for (vtkAlgorithm* filter : filters)
  {
    this->expectError(filter, blocks, "Merge Blocks");
  }
}

TEST_F(VtkMeshInput, OfDuplicatesHasNothingToWorkOn)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  ghosts->SetNumberOfTuples(this->Held->GetNumberOfCells());
  ghosts->Fill(vtkDataSetAttributes::DUPLICATECELL);
  this->Held->GetCellData()->AddArray(ghosts);
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  this->expectError(this->Handle, this->Held, "all of them are marked as duplicates");
  this->expectError(this->Deformation, this->Held, "all of them are marked as duplicates");
}

} // namespace
} // namespace smg::testing
