// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/vtkDraggedPreview.h"

#include "IO/vtkPieceCells.h"
#include "smg/DeformationDescription.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <numeric>

namespace smg
{
namespace
{

/** A patch of held points up to this size counts as small: it could vanish in a coarser mesh. */
constexpr std::int64_t SmallPatch = 64;

/** Patches of held points that edges connect: each point leads to the first of its patch. */
class HeldPatches
{
public:
  HeldPatches(const std::vector<std::uint8_t>& held, const std::vector<std::int64_t>& corners)
    : Up(held.size())
    , Sizes(held.size(), 1)
  {
    std::iota(this->Up.begin(), this->Up.end(), 0);
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      const std::size_t next = k % 3 == 2 ? k - 2 : k + 1;
      const auto a = static_cast<std::size_t>(corners[k]);
      const auto b = static_cast<std::size_t>(corners[next]);
      if (held[a] && held[b])
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

/** Of each point: whether it is of a small handle. */
std::vector<std::uint8_t> smallHandles(vtkPointSet& preview)
{
  std::vector<std::uint8_t> held(static_cast<std::size_t>(preview.GetNumberOfPoints()), 0);
  vtkDataArray* mask = preview.GetPointData()->GetArray(HandleMaskName);
  for (std::size_t i = 0; mask && i < held.size(); ++i)
  {
    held[i] = mask->GetTuple1(static_cast<vtkIdType>(i)) != 0.0 ? 1 : 0;
  }
  HeldPatches patches(held, cellCorners(preview, CellType::Triangle, "The preview"));
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    held[i] = held[i] && patches.size(i) <= SmallPatch ? 1 : 0;
  }
  return held;
}

} // namespace

vtkSmartPointer<vtkPointSet> DraggedPreview::of(vtkPointSet& preview, std::int64_t most)
{
  if (preview.GetNumberOfPoints() <= most || !CoarserPreview::isPossible(preview))
  {
    this->Coarser.reset();
    return &preview;
  }
  std::vector<std::uint8_t> small = smallHandles(preview);
  vtkPoints* points = preview.GetPoints();
  if (!this->Coarser || this->Points != points || this->Time != points->GetMTime() ||
      this->Small != small || this->Most != most)
  {
    this->Coarser.emplace(preview, most, small);
    this->Points = points;
    this->Time = points->GetMTime();
    this->Small = std::move(small);
    this->Most = most;
  }
  return this->Coarser->of(preview);
}

} // namespace smg
