// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/MemorySource.h"

#include <algorithm>
#include <utility>

namespace smg::testing
{
namespace
{

/** Rows [first, end) of each column. */
void sliceColumns(
  const std::vector<Column>& from, std::int64_t first, std::int64_t end, std::vector<Column>& to)
{
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const auto size = static_cast<std::int64_t>(from[i].spec.tupleBytes());
    to[i].spec = from[i].spec;
    to[i].bytes.assign(from[i].bytes.begin() + first * size, from[i].bytes.begin() + end * size);
  }
}

} // namespace

MemorySource::MemorySource(StreamMesh mesh, std::int64_t blockCells)
  : Mesh(std::move(mesh))
  , BlockCells(blockCells)
{
  this->Info.cellType = this->Mesh.cellType;
  this->Info.groups = this->Mesh.groups;
  this->Info.vertices = this->Mesh.vertices();
  this->Info.cells = this->Mesh.cells();
  for (const Column& column : this->Mesh.vertexColumns)
  {
    this->Info.vertexColumns.push_back(column.spec);
  }
  for (const Column& column : this->Mesh.cellColumns)
  {
    this->Info.cellColumns.push_back(column.spec);
  }
  this->measure();
}

void MemorySource::measure()
{
  for (int k = 0; k < 3 && this->Info.vertices > 0; ++k)
  {
    auto [low, high] = std::pair(this->Mesh.positions[k], this->Mesh.positions[k]);
    for (std::int64_t v = 0; v < this->Info.vertices; ++v)
    {
      low = std::min(low, this->Mesh.positions[3 * v + k]);
      high = std::max(high, this->Mesh.positions[3 * v + k]);
    }
    this->Info.bounds[2 * k] = low;
    this->Info.bounds[2 * k + 1] = high;
  }

  const int size = cornersOf(this->Info.cellType);
  std::vector<std::int64_t> lastCell(this->Info.vertices, -1);
  for (std::int64_t c = 0; c < this->Info.cells; ++c)
  {
    for (int k = 0; k < size; ++k)
    {
      lastCell[this->Mesh.corners[size * c + k]] = c;
    }
  }
  this->Info.width = 0;
  this->Info.span = 0;
  std::int64_t introduced = 0;
  std::int64_t finished = 0;
  std::int64_t prefix = 0;
  for (std::int64_t c = 0; c < this->Info.cells; ++c)
  {
    const auto corners = this->Mesh.corners.begin() + size * c;
    const auto [low, high] = std::minmax_element(corners, corners + size);
    this->Info.span = std::max(this->Info.span, *high - *low);
    introduced = std::max(introduced, *high + 1);
    this->Info.width = std::max(this->Info.width, introduced - finished);
    for (int k = 0; k < size; ++k)
    {
      // A repeated corner of the cell is finalized once.
      const bool repeated = std::find(corners, corners + k, corners[k]) != corners + k;
      finished += lastCell[corners[k]] == c && !repeated ? 1 : 0;
    }
    while (prefix < introduced && lastCell[prefix] <= c)
    {
      ++prefix;
    }
    this->NewVertices.push_back(introduced);
    this->Finalized.push_back(prefix);
  }
}

void MemorySource::rewind(std::int64_t blockCells)
{
  this->BlockCells = blockCells;
  this->NextCell = 0;
  this->NextVertex = 0;
}

bool MemorySource::next(MeshBlock& block)
{
  if (this->NextCell == this->Info.cells && this->NextVertex == this->Info.vertices)
  {
    return false;
  }
  const std::int64_t first = this->NextCell;
  const std::int64_t end = std::min(first + this->BlockCells, this->Info.cells);
  // Vertices that no cell uses come at the end.
  const bool isLast = end == this->Info.cells;
  const std::int64_t firstVertex = this->NextVertex;
  const std::int64_t endVertex = isLast ? this->Info.vertices : this->NewVertices[end - 1];
  const int size = cornersOf(this->Info.cellType);
  block.firstVertex = firstVertex;
  block.firstCell = first;
  block.positions.assign(
    this->Mesh.positions.begin() + 3 * firstVertex, this->Mesh.positions.begin() + 3 * endVertex);
  block.corners.assign(
    this->Mesh.corners.begin() + size * first, this->Mesh.corners.begin() + size * end);
  sliceColumns(this->Mesh.vertexColumns, firstVertex, endVertex, block.vertexColumns);
  sliceColumns(this->Mesh.cellColumns, first, end, block.cellColumns);
  block.finalized = isLast ? this->Info.vertices : this->Finalized[end - 1];
  this->NextCell = end;
  this->NextVertex = endVertex;
  return true;
}

} // namespace smg::testing
