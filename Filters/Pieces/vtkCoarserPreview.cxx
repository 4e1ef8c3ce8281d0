// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/vtkCoarserPreview.h"

#include "Filters/Pieces/vtkCellParts.h"
#include "IO/Preview/StreamPreview.h"
#include "IO/vtkMeshPieceData.h"
#include "IO/vtkPieceCells.h"
#include "Solver/Core/DisjointSets.h"

#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <cstddef>
#include <string_view>
#include <utility>

namespace smg
{
namespace
{

/** A patch of marked points up to this size counts as small. */
constexpr std::int64_t SmallPatch = 64;

/** The number of points of the patch of each point: of the marked points that edges connect. */
std::vector<std::int64_t> patchSizes(
  const std::vector<std::uint8_t>& marked, const std::vector<std::int64_t>& corners)
{
  DisjointSets<std::size_t> patches(marked.size());
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const auto a = static_cast<std::size_t>(corners[k]);
    const auto b = static_cast<std::size_t>(corners[k % 3 == 2 ? k - 2 : k + 1]);
    if (marked[a] && marked[b])
    {
      patches.join(a, b);
    }
  }
  std::vector<std::int64_t> sizes(marked.size(), 0);
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    ++sizes[patches.first(i)];
  }
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    sizes[i] = sizes[patches.first(i)];
  }
  return sizes;
}

/** Marks what a mask is not 0 at; the arrays of pieces are none. */
void markBy(vtkAbstractArray* array, std::vector<std::uint8_t>& marked)
{
  auto* mask = vtkUnsignedCharArray::SafeDownCast(array);
  const std::string_view name = mask && mask->GetName() ? mask->GetName() : "";
  if (!mask || mask->GetNumberOfComponents() != 1 || name == GhostTypeName ||
      name == StreamFinalizedName)
  {
    return;
  }
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    marked[i] |= mask->GetValue(static_cast<vtkIdType>(i)) != 0 ? 1 : 0;
  }
}

} // namespace

std::vector<std::uint8_t> smallPatches(vtkPointSet& surface)
{
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(surface.GetNumberOfPoints()), 0);
  for (int k = 0; k < surface.GetPointData()->GetNumberOfArrays(); ++k)
  {
    markBy(surface.GetPointData()->GetAbstractArray(k), marked);
  }
  const std::vector<std::int64_t> sizes =
    patchSizes(marked, cellCorners(surface, CellType::Triangle, "The preview"));
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    marked[i] = marked[i] && sizes[i] <= SmallPatch ? 1 : 0;
  }
  return marked;
}

bool CoarserPreview::isPossible(vtkPointSet& preview)
{
  return preview.GetNumberOfCells() > 0 && hasSimplices(preview) &&
         cellTypeOf(preview, "The preview") == CellType::Triangle;
}

CoarserPreview::CoarserPreview(
  vtkPointSet& preview, std::int64_t most, std::span<const std::uint8_t> locked)
{
  const auto count = static_cast<std::size_t>(preview.GetNumberOfPoints());
  std::vector<double> positions(3 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    preview.GetPoint(static_cast<vtkIdType>(i), positions.data() + 3 * i);
  }
  CoarserSurface surface = coarserSurface(
    positions, cellCorners(preview, CellType::Triangle, "The preview"), locked, most);
  this->Points = std::move(surface.vertices);
  this->Corners = std::move(surface.corners);
  this->Places = vtkSmartPointer<vtkPoints>::New();
  this->Places->SetDataType(preview.GetPoints()->GetDataType());
  this->Places->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    this->Places->SetPoint(static_cast<vtkIdType>(i), preview.GetPoint(this->Points[i]));
  }
}

vtkSmartPointer<vtkPointSet> CoarserPreview::of(vtkPointSet& preview) const
{
  auto mesh = vtkSmartPointer<vtkPointSet>::Take(preview.NewInstance());
  mesh->SetPoints(this->Places);
  setCells(*mesh, this->Corners, cornersOf(CellType::Triangle));
  copyRows(*preview.GetPointData(), this->Points, *mesh->GetPointData());
  mesh->GetFieldData()->ShallowCopy(preview.GetFieldData());
  return mesh;
}

const CoarserPreview& KeptCoarserPreview::of(vtkPointSet& preview, std::int64_t most)
{
  std::vector<std::uint8_t> small = smallPatches(preview);
  vtkPoints* points = preview.GetPoints();
  if (!this->Coarser || this->Points != points || this->Time != points->GetMTime() ||
      this->Cells != preview.GetNumberOfCells() || this->Small != small || this->Most != most)
  {
    this->Coarser.emplace(preview, most, small);
    this->Points = points;
    this->Time = points->GetMTime();
    this->Cells = preview.GetNumberOfCells();
    this->Small = std::move(small);
    this->Most = most;
  }
  return *this->Coarser;
}

} // namespace smg
