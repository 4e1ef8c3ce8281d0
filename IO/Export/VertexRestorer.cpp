// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/VertexRestorer.h"

#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace smg
{

namespace
{

/** The approximate bytes of vertices delivered at once. */
constexpr std::size_t VertexChunkBytes = std::size_t(512) << 10;

} // namespace

VertexRestorer::VertexRestorer(
  Workspace& workspace, std::int64_t memory, const RestoredInfo& info, std::string name)
  : Name(std::move(name))
  , DoublePositions(info.doublePositions)
  , PositionBytes(3 * (info.doublePositions ? sizeof(double) : sizeof(float)))
  , Columns(info.vertexColumns)
  , Count(info.vertices)
  , Chunk(static_cast<std::int64_t>(std::clamp<std::size_t>(
      VertexChunkBytes / (this->PositionBytes + this->Columns.bytes()), 1, 8192)))
  , Sorted(workspace, memory, this->PositionBytes + this->Columns.bytes())
{
}

void VertexRestorer::fail(const std::string& what) const
{
  throw Error(
    this->Name + ": " + what +
    ", so the original order cannot be restored: take the whole mesh that was converted, "
    "with its column OriginalId, or the .vsm file of it that has its points of no cell, too.");
}

void VertexRestorer::put(std::span<const std::int64_t> ids, std::span<const double> positions,
  const std::vector<Column>& columns)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] < 0 || ids[i] >= this->Count)
    {
      this->fail("a vertex has the original number " + std::to_string(ids[i]) +
                 ", but there are only " + std::to_string(this->Count) + " vertices");
    }
    std::byte* const row = this->Sorted.put(static_cast<std::uint64_t>(ids[i]));
    const std::span<const double> position = positions.subspan(3 * i, 3);
    if (this->DoublePositions)
    {
      std::memcpy(row, position.data(), this->PositionBytes);
    }
    else
    {
      const std::array<float, 3> single{ static_cast<float>(position[0]),
        static_cast<float>(position[1]), static_cast<float>(position[2]) };
      std::memcpy(row, single.data(), this->PositionBytes);
    }
    this->Columns.gather(columns, i, row + this->PositionBytes);
  }
}

bool VertexRestorer::next(RestoredVertices& vertices)
{
  vertices.first = this->Next;
  vertices.positions.clear();
  vertices.columns = emptyColumns(this->Columns.specs(), static_cast<std::size_t>(this->Chunk));
  RowSort::Row row;
  for (std::int64_t i = 0; i < this->Chunk && this->Sorted.next(row); ++i, ++this->Next)
  {
    // All numbers are below the number of vertices: if one is missing, another occurs twice.
    if (row.key != static_cast<std::uint64_t>(this->Next))
    {
      this->fail(row.key < static_cast<std::uint64_t>(this->Next)
                   ? "two vertices have the original number " + std::to_string(row.key)
                   : "no vertex has the original number " + std::to_string(this->Next));
    }
    if (this->DoublePositions)
    {
      std::array<double, 3> position;
      std::memcpy(position.data(), row.bytes, sizeof(position));
      vertices.positions.insert(vertices.positions.end(), position.begin(), position.end());
    }
    else
    {
      std::array<float, 3> position;
      std::memcpy(position.data(), row.bytes, sizeof(position));
      vertices.positions.insert(vertices.positions.end(), position.begin(), position.end());
    }
    this->Columns.append(row.bytes + this->PositionBytes, vertices.columns);
  }
  return !vertices.positions.empty();
}

} // namespace smg
