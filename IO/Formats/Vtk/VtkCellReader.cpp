// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkCellReader.h"

#include "IO/External/ExternalSort.h"
#include "IO/Formats/Vtk/VtkArrayReader.h"
#include "IO/Formats/Vtk/VtkCell.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <string>

namespace smg
{

VtkCellReader::VtkCellReader(
  VtkFiles& files, std::size_t file, const VtkCellList& list, Workspace& workspace, bool takesLines)
  : Cells(list.cells)
  , Type(list.type)
  , TakesLines(takesLines)
{
  if (list.cells == 0)
  {
    return;
  }
  this->Points.emplace(files.open(file, VtkFiles::Main), *list.points, workspace);
  if (list.offsets)
  {
    this->Offsets.emplace(files.open(file, VtkFiles::Offsets), *list.offsets, workspace);
    if (list.offsets->values == list.cells + 1 && this->Offsets->next() != 0)
    {
      this->Offsets->fail("should begin with 0");
    }
  }
  if (list.types)
  {
    this->Types.emplace(files.open(file, VtkFiles::Types), *list.types, workspace);
  }
}

std::int64_t VtkCellReader::nextSize()
{
  if (!this->Offsets)
  {
    const std::int64_t size = this->Points->next();
    if (size < 0)
    {
      this->Points->fail("says that cell " + std::to_string(this->Cell) + " has " +
                         std::to_string(size) + " points");
    }
    return size;
  }
  const std::int64_t end = this->Offsets->next();
  if (end < this->Last)
  {
    this->Offsets->fail("says that cell " + std::to_string(this->Cell) + " ends at " +
                        std::to_string(end) + ", before it begins");
  }
  const std::int64_t size = end - this->Last;
  this->Last = end;
  return size;
}

std::span<const std::int64_t> VtkCellReader::next()
{
  if (this->Types)
  {
    const std::int64_t type = this->Types->next();
    this->Type = type >= 0 && type < 256 ? static_cast<int>(type) : 255;
  }
  const std::int64_t size = this->nextSize();
  if (isPointOrLine(this->Type) && (!this->TakesLines || size > MaxPoints))
  {
    this->Points->skip(size);
    ++this->Cell;
    return {};
  }
  if (size > MaxPoints)
  {
    this->Points->fail("has a cell, number " + std::to_string(this->Cell) + ", of " +
                       std::to_string(size) + " points; at most " + std::to_string(MaxPoints) +
                       " are read");
  }
  ++this->Cell;
  return this->Points->next(static_cast<std::size_t>(size));
}

void VtkCellReader::finish()
{
  if (this->Points && !this->Points->atEnd())
  {
    this->Points->fail("has more numbers than its cells take: a count is wrong");
  }
  if (this->Offsets && !this->Offsets->atEnd())
  {
    this->Offsets->fail("has more numbers than there are cells: a count is wrong");
  }
}

void convertVtkScalars(
  const VtkArray& array, const std::byte* from, std::size_t count, std::byte* to)
{
  dispatch(array.type,
    [&]<class From>(From)
    {
      dispatch(array.columnType,
        [&]<class To>(To)
        {
          for (std::size_t i = 0; i < count; ++i)
          {
            From value;
            std::memcpy(&value, from + i * sizeof(From), sizeof(From));
            To result{};
            if (array.isFractions)
            {
              const double clamped = std::clamp(static_cast<double>(value), 0.0, 1.0);
              result = static_cast<To>(std::lround(std::isnan(clamped) ? 0.0 : clamped * 255.0));
            }
            else
            {
              result = static_cast<To>(value);
            }
            std::memcpy(to + i * sizeof(To), &result, sizeof(To));
          }
        });
    });
}

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
