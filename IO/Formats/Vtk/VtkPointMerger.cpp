// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkPointMerger.h"

#include "IO/External/ExternalSort.h"
#include "IO/Formats/Vtk/VtkArrayReader.h"

#include <algorithm>
#include <compare>

namespace smg
{

namespace
{

/** A point of all pieces and its global number. */
struct NumberedPoint
{
  std::int64_t number;
  std::uint32_t point;
  auto operator<=>(const NumberedPoint&) const = default;
};

/** A point that is merged with the first one that has its global number. */
struct MergedPoint
{
  std::uint32_t first;
  std::uint32_t point;
  auto operator<=>(const MergedPoint&) const = default;
};

const VtkArray* globalIdsOf(const VtkPiece& piece)
{
  const auto found = std::ranges::find(piece.pointArrays, piece.globalIds, &VtkArray::name);
  return found == piece.pointArrays.end() || found->components != 1 ? nullptr : &*found;
}

void sortNumbers(VtkFiles& files, const VtkLayout& layout, Workspace& workspace,
  ExternalSort<NumberedPoint>& numbered)
{
  std::int64_t point = 0;
  for (const VtkPiece& piece : layout.pieces)
  {
    if (piece.points == 0)
    {
      continue;
    }
    InputFile& file = files.open(piece.file, VtkFiles::Main);
    VtkIndexReader numbers(file, *globalIdsOf(piece), workspace);
    for (std::int64_t i = 0; i < piece.points; ++i, ++point)
    {
      if (point >= std::int64_t(NoIndex) - 1)
      {
        numbers.fail("belongs to a mesh whose pieces have more than 4294967294 points, which are "
                     "too many");
      }
      numbered.put({ numbers.next(), static_cast<std::uint32_t>(point) });
    }
  }
  numbered.sort();
}

} // namespace

bool VtkPointMerger::applies(const VtkLayout& layout)
{
  return layout.pieces.size() > 1 && std::ranges::all_of(layout.pieces, [](const VtkPiece& piece)
                                       { return piece.points == 0 || globalIdsOf(piece); });
}

VtkPointMerger::VtkPointMerger(VtkFiles& files, const VtkLayout& layout, RawMeshBuilder& builder)
  : Merged(builder.workspace())
{
  Workspace& workspace = builder.workspace();
  const std::int64_t memory = workspace.available() / 4;
  ExternalSort<MergedPoint> byFirst(workspace, memory);
  ExternalSort<std::uint32_t> byPoint(workspace, memory);
  std::int64_t points = 0;
  {
    ExternalSort<NumberedPoint> numbered(workspace, memory);
    sortNumbers(files, layout, workspace, numbered);
    points = numbered.size();
    NumberedPoint first{ -1, NoIndex };
    for (NumberedPoint next{}; numbered.next(next);)
    {
      if (first.point != NoIndex && next.number == first.number)
      {
        byFirst.put({ first.point, next.point });
        byPoint.put(next.point);
      }
      else
      {
        first = next;
      }
    }
  }
  byPoint.sort();
  for (std::uint32_t point = 0; byPoint.next(point);)
  {
    this->Merged.put(point);
  }
  this->Merged.close();
  byFirst.sort();
  Relabelling vertices(workspace, std::max<std::int64_t>(points, 1), memory);
  MergedPoint merged{};
  bool more = byFirst.next(merged);
  std::uint32_t vertex = 0;
  Walk walk(*this);
  for (std::uint32_t point = 0; point < static_cast<std::uint32_t>(points); ++point)
  {
    if (!walk.next())
    {
      continue;
    }
    vertices.put(point, vertex);
    for (; more && merged.first == point; more = byFirst.next(merged))
    {
      vertices.put(merged.point, vertex);
    }
    ++vertex;
  }
  builder.noteMerged(points - static_cast<std::int64_t>(vertex));
  builder.relabelCorners(std::move(vertices));
}

} // namespace smg
