// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesh/vtkCoarserPreview.h"

#include "Filters/Mesh/vtkCopiedRows.h"
#include "IO/Preview/CoarserSurface.h"
#include "IO/vtkPieceCells.h"
#include "IO/vtkPieceNames.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <numeric>
#include <string_view>
#include <utility>

namespace smg
{
namespace
{

/** A patch of marked points up to this size counts as small. */
constexpr std::int64_t SmallPatch = 64;

/** Patches of marked points that edges connect: each point leads to the first of its patch. */
class MarkedPatches
{
public:
  MarkedPatches(const std::vector<std::uint8_t>& marked, const std::vector<std::int64_t>& corners)
    : Up(marked.size())
    , Sizes(marked.size(), 1)
  {
    std::iota(this->Up.begin(), this->Up.end(), 0);
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      const std::size_t next = k % 3 == 2 ? k - 2 : k + 1;
      const auto a = static_cast<std::size_t>(corners[k]);
      const auto b = static_cast<std::size_t>(corners[next]);
      if (marked[a] && marked[b])
      {
        this->join(this->first(a), this->first(b));
      }
    }
  }

  std::int64_t size(std::size_t point) { return this->Sizes[this->first(point)]; }

private:
  std::size_t first(std::size_t point)
  {
    while (this->Up[point] != point)
    {
      point = this->Up[point] = this->Up[this->Up[point]];
    }
    return point;
  }

  void join(std::size_t a, std::size_t b)
  {
    if (a != b)
    {
      this->Up[b] = a;
      this->Sizes[a] += this->Sizes[b];
    }
  }

  std::vector<std::size_t> Up;
  std::vector<std::int64_t> Sizes;
};

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
  MarkedPatches patches(marked, cellCorners(surface, CellType::Triangle, "The preview"));
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    marked[i] = marked[i] && patches.size(i) <= SmallPatch ? 1 : 0;
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
}

vtkSmartPointer<vtkPointSet> CoarserPreview::of(vtkPointSet& preview) const
{
  auto mesh = vtkSmartPointer<vtkPointSet>::Take(preview.NewInstance());
  vtkNew<vtkPoints> points;
  points->SetDataType(preview.GetPoints()->GetDataType());
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), preview.GetPoint(this->Points[i]));
  }
  mesh->SetPoints(points);
  setCells(*mesh, this->Corners, cornersOf(CellType::Triangle));
  copyRows(*preview.GetPointData(), this->Points, *mesh->GetPointData());
  mesh->GetFieldData()->ShallowCopy(preview.GetFieldData());
  return mesh;
}

} // namespace smg
