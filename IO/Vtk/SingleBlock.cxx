// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/SingleBlock.h"

#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "smg/Error.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationDataObjectKey.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <cstdint>
#include <optional>

namespace smg
{
namespace
{

using BlockIterator = vtkSmartPointer<vtkCompositeDataIterator>;

void requireNoPreview(vtkDataObject* block)
{
  auto* mesh = vtkPointSet::SafeDownCast(block);
  if (mesh && isPreview(*mesh))
  {
    throw Error("A block of the input is the preview of a mesh: put this filter between the reader "
                "of the mesh and the filter that makes blocks.");
  }
}

bool hasCells(vtkDataObject* block)
{
  auto* mesh = vtkDataSet::SafeDownCast(block);
  return mesh && mesh->GetNumberOfCells() > 0;
}

/** At the leaf of `blocks` with this index. */
BlockIterator blockAt(vtkCompositeDataSet& blocks, unsigned int flatIndex)
{
  auto at = BlockIterator::Take(blocks.NewIterator());
  for (at->InitTraversal(); !at->IsDoneWithTraversal(); at->GoToNextItem())
  {
    if (at->GetCurrentFlatIndex() == flatIndex)
    {
      return at;
    }
  }
  throw Error("The blocks of the input have changed: apply the filter again.");
}

/** The index of the single block with cells of `blocks`. */
unsigned int singleBlock(vtkCompositeDataSet& blocks)
{
  if (blocks.IsA("vtkUniformGridAMR"))
  {
    throw Error("The input is an image with refined parts (AMR), not a mesh: make tetrahedra of it "
                "with Tetrahedralize, and one mesh of these with Merge Blocks.");
  }
  if (hasSeveralProcesses())
  {
    throw Error("The input consists of blocks, on which several processes cannot work: make them "
                "one mesh with Merge Blocks, save it as .vsm and open that.");
  }
  std::optional<unsigned int> found;
  std::int64_t count = 0;
  const auto at = BlockIterator::Take(blocks.NewIterator());
  for (at->InitTraversal(); !at->IsDoneWithTraversal(); at->GoToNextItem())
  {
    if (!hasCells(at->GetCurrentDataObject()))
    {
      continue;
    }
    requireNoPreview(at->GetCurrentDataObject());
    ++count; // one of the others may be a preview
    found = at->GetCurrentFlatIndex();
  }
  if (count > 1)
  {
    throw Error("The input has several blocks with cells: take one with Extract Block, or make "
                "them one mesh with Merge Blocks.");
  }
  if (!found)
  {
    throw Error("The input has blocks, but none with cells: look at what the filter before it "
                "delivers.");
  }
  return *found;
}

/** The mesh of a block, to which nothing refers as to a piece of a mesh stream. */
vtkSmartPointer<vtkPointSet> ordinaryMesh(vtkDataObject& block)
{
  if (!block.IsA("vtkPolyData") && !block.IsA("vtkUnstructuredGrid"))
  {
    throw Error("The block with cells of the input is an image or a structured grid, not a mesh: "
                "make tetrahedra of it with Tetrahedralize.");
  }
  auto* mesh = vtkPointSet::SafeDownCast(&block);
  if (lacksStreamNumbering(*mesh))
  {
    return mesh;
  }
  const auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh->NewInstance());
  copy->ShallowCopy(mesh);
  vtkPointData& points = *copy->GetPointData();
  if (vtkDataArray* ids = points.GetGlobalIds())
  {
    points.SetGlobalIds(nullptr);
    points.RemoveArray(ids->GetName());
  }
  points.RemoveArray(GlobalIdsName);
  return copy;
}

/** Puts a mesh in the place of the output, for a while. */
class MeshAsOutput
{
public:
  MeshAsOutput(vtkInformation& info, vtkPointSet& mesh)
    : Info(info)
    , Before(vtkDataObject::GetData(&info))
  {
    info.Set(vtkDataObject::DATA_OBJECT(), &mesh);
  }
  ~MeshAsOutput() { this->Info.Set(vtkDataObject::DATA_OBJECT(), this->Before); }
  MeshAsOutput(const MeshAsOutput&) = delete;
  MeshAsOutput& operator=(const MeshAsOutput&) = delete;

private:
  vtkInformation& Info;
  vtkSmartPointer<vtkDataObject> Before;
};

} // namespace

vtkSmartPointer<vtkPointSet> meshOf(vtkDataObject* data)
{
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    return ordinaryMesh(*blockAt(*blocks, singleBlock(*blocks))->GetCurrentDataObject());
  }
  return vtkPointSet::SafeDownCast(data);
}

void throughSingleBlock(
  vtkDataObject* input, vtkInformation& output, const std::function<void()>& work)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(input);
  auto* result = vtkCompositeDataSet::SafeDownCast(vtkDataObject::GetData(&output));
  if (!blocks || !result)
  {
    work();
    return;
  }
  const unsigned int place = singleBlock(*blocks);
  const auto mesh = vtkSmartPointer<vtkPointSet>::Take(meshOf(input)->NewInstance());
  {
    const MeshAsOutput replaced(output, *mesh);
    work();
  }
  // The work may have asked for the input anew, so no iterator outlives it. Blocks inside blocks
  // are copied: the input keeps its own.
  result->CopyStructure(blocks);
  result->GetFieldData()->ShallowCopy(blocks->GetFieldData());
  const auto at = BlockIterator::Take(blocks->NewIterator());
  for (at->InitTraversal(); !at->IsDoneWithTraversal(); at->GoToNextItem())
  {
    result->SetDataSet(at, at->GetCurrentDataObject());
  }
  result->SetDataSet(blockAt(*blocks, place), mesh);
}

} // namespace smg
