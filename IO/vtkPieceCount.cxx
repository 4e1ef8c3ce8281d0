// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkPieceCount.h"

#include "IO/vtkPieceInput.h"
#include "smg/MeshSource.h"

#include "vtkDataObject.h"

#include <algorithm>
#include <optional>

namespace smg
{
namespace
{

std::int64_t tupleBytes(const std::vector<ColumnSpec>& columns)
{
  std::int64_t bytes = 0;
  for (const ColumnSpec& column : columns)
  {
    bytes += column.components * static_cast<std::int64_t>(sizeOf(column.type));
  }
  return bytes;
}

/** The number of pieces of at most so many bytes as VTK data objects, as setPiece() makes them. */
std::int64_t piecesOf(const StreamInfo& info, std::int64_t pieceBytes)
{
  constexpr std::int64_t IdBytes = 8, MarkBytes = 2, OffsetBytes = 8, TypeBytes = 1;
  const std::int64_t pointBytes =
    3 * (info.doublePositions ? 8 : 4) + IdBytes + MarkBytes + tupleBytes(info.vertexColumns);
  const std::int64_t cellBytes =
    OffsetBytes + TypeBytes + IdBytes * cornersOf(info.cellType) + tupleBytes(info.cellColumns);
  // Besides its own points a piece has those that are alive at its first cell.
  const std::int64_t ownBytes =
    std::max(pieceBytes - pointBytes * std::max<std::int64_t>(0, info.width), pieceBytes / 2 + 1);
  return (info.vertices * pointBytes + info.cells * cellBytes) / ownBytes + 1;
}

} // namespace

PieceCount PieceCount::within(int given, std::int64_t memoryLimit)
{
  // Reader, filters and the mesh stream copy a piece several times.
  constexpr std::int64_t Copies = 16;
  return { .given = given, .pieceBytes = std::max<std::int64_t>(1, memoryLimit / Copies) };
}

int PieceCount::first(PieceInput& input) const
{
  if (this->given > 0)
  {
    return this->given;
  }
  const std::optional<StreamInfo> info = input.meshInfo();
  if (!info)
  {
    return Usual;
  }
  return static_cast<int>(
    std::clamp<std::int64_t>(piecesOf(*info, this->pieceBytes), this->least, Most));
}

int PieceCount::enough(int pieces, vtkDataObject& piece) const
{
  if (this->given > 0)
  {
    return this->given;
  }
  constexpr double Kibibyte = 1024;
  const double bytes = Kibibyte * static_cast<double>(piece.GetActualMemorySize());
  const double wanted = pieces * bytes / static_cast<double>(this->pieceBytes) + 1.0;
  return static_cast<int>(std::clamp(wanted, double(this->least), double(Most)));
}

} // namespace smg
