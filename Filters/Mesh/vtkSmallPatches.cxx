// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesh/vtkSmallPatches.h"

#include "IO/vtkPieceCells.h"
#include "IO/vtkPieceNames.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <numeric>
#include <string_view>

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

} // namespace smg
