// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshHandle.h"
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkStreamingMeshPreview.h"
#include "Filters/vtkStreamingMeshSimplification.h"
#include "Filters/vtkStreamingPoisson.h"
#include "Testing/Filters/DeformationFixture.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
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

/** The structure is kept: the result takes the place of the block, and the other is passed. */
TEST_F(VtkMeshInput, OfOneBlockWithCellsIsThatBlock)
{
  vtkNew<vtkPolyData> ordinary; // what a block is
  ordinary->ShallowCopy(this->Held);
  ordinary->GetPointData()->SetGlobalIds(nullptr);
  ordinary->GetPointData()->RemoveArray("GlobalIds");
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, this->Held);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, nothing);
  blocks->SetBlock(1, inner);
  vtkNew<vtkMeshRegion> region;
  region->SetRegion(vtkMeshRegion::EVERYWHERE);
  this->Handle->SetRegion(vtkMeshHandle::EVERYWHERE);
  vtkNew<vtkStreamingMeshSimplification> simplified;
  simplified->SetNumberOfVertices(100);
  const std::vector<vtkAlgorithm*> filters{ region, this->Handle, this->Deformation, simplified };
  for (vtkAlgorithm* filter : filters)
  {
    SCOPED_TRACE(filter->GetClassName());
    const Errors errors(filter);
    const auto result = [&](vtkDataObject* input)
    {
      filter->SetInputDataObject(input);
      EXPECT_TRUE(updatePiece(filter, 0, 1)) << errors.text();
      return filter->GetOutputDataObject(0);
    };
    vtkNew<vtkPolyData> expected;
    expected->ShallowCopy(result(ordinary));
    vtkDataObject* found = result(blocks);
    if (auto* outer = vtkMultiBlockDataSet::SafeDownCast(found))
    {
      EXPECT_TRUE(vtkPolyData::SafeDownCast(outer->GetBlock(0)));
      found = vtkMultiBlockDataSet::SafeDownCast(outer->GetBlock(1))->GetBlock(1);
    }
    auto* mesh = vtkPolyData::SafeDownCast(found);
    ASSERT_TRUE(mesh);
    ASSERT_EQ(mesh->GetNumberOfPoints(), expected->GetNumberOfPoints());
    ASSERT_GT(mesh->GetNumberOfCells(), 0);
    EXPECT_EQ(
      mesh->GetPointData()->GetNumberOfArrays(), expected->GetPointData()->GetNumberOfArrays());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_EQ(mesh->GetPoint(i)[k], expected->GetPoint(i)[k]) << i;
      }
    }
  }
}

TEST_F(VtkMeshInput, OfAPreviewAmongBlocksIsRefused)
{
  vtkNew<vtkPolyData> preview;
  preview->DeepCopy(this->Held);
  vtkNew<vtkIntArray> mark;
  mark->SetName("Preview");
  mark->InsertNextValue(1);
  preview->GetFieldData()->AddArray(mark);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, preview);
  this->expectError(this->Handle, blocks, "is the preview of a mesh");
  vtkNew<vtkMultiBlockDataSet> nothing;
  nothing->SetBlock(0, vtkNew<vtkPolyData>());
  this->expectError(this->Handle, nothing, "none with cells");
}

TEST_F(VtkMeshInput, OfDuplicatesOrHiddenCellsHasNothingToWorkOn)
{
  for (const int mark : { vtkDataSetAttributes::DUPLICATECELL, vtkDataSetAttributes::REFINEDCELL,
         vtkDataSetAttributes::HIDDENCELL })
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    ghosts->SetNumberOfTuples(this->Held->GetNumberOfCells());
    ghosts->Fill(mark);
    this->Held->GetCellData()->AddArray(ghosts);
    this->Handle->SetRegion(vtkMeshHandle::POINTS);
    this->Handle->RemoveAllPoints();
    this->Handle->AddPoint(3.0, 0.0, 0.0);
    this->expectError(this->Handle, this->Held, "all of them are marked as duplicates or hidden");
    this->expectError(
      this->Deformation, this->Held, "all of them are marked as duplicates or hidden");
  }
}

} // namespace
} // namespace smg::testing
