// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/LayoutSource.h"

#include "IO/Container/Columns.h"
#include "IO/Formats/StreamConversion.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace smg
{

namespace
{

constexpr std::size_t BlockCells = 16384;

/** Original numbers that the mesh may have already; anything else under their name goes. */
const ColumnSpec IdSpec{ OriginalIdName, ScalarType::Int64, 1 };
const ColumnSpec CellIdSpec{ OriginalCellIdName, ScalarType::Int64, 1 };

/** Whether a column of the mesh goes into the stream as it is. */
bool isKept(const ColumnSpec& spec)
{
  const bool numbers = spec.name == IdSpec.name || spec.name == CellIdSpec.name;
  return spec.name != CellFlagsName && (!numbers || spec == IdSpec || spec == CellIdSpec);
}

/** The original numbers of the rows: from `numbers`, or the rows themselves if there are none. */
void number(const ColumnSpec& spec, std::span<const std::uint32_t> rows,
  const std::vector<std::int64_t>& numbers, Column& to)
{
  to.spec = spec;
  to.resize(rows.size());
  std::transform(rows.begin(), rows.end(), to.as<std::int64_t>().begin(),
    [&numbers](std::uint32_t row) { return numbers.empty() ? std::int64_t(row) : numbers[row]; });
}

} // namespace

LayoutSource::LayoutSource(const IndexedMesh& mesh, const StreamLayout& layout, CellIds cellIds)
  : Mesh(mesh)
  , Layout(layout)
{
  this->AddIds = findColumn(mesh.vertexColumns, IdSpec) < 0;
  this->AddCellIds = cellIds == WithCellIds && findColumn(mesh.cellColumns, CellIdSpec) < 0;
  this->AddFlags = layout.degenerateCells > 0 || layout.duplicateCells > 0;
  this->Info.cellType = mesh.cellType;
  this->Info.vertices = static_cast<std::int64_t>(layout.vertices.size());
  this->Info.cells = static_cast<std::int64_t>(layout.cells.size());
  this->Info.doublePositions = mesh.doublePositions;
  const auto addKept = [](const std::vector<Column>& columns, std::vector<ColumnSpec>& specs)
  {
    for (const Column& column : columns)
    {
      if (isKept(column.spec))
      {
        specs.push_back(column.spec);
      }
    }
  };
  addKept(mesh.vertexColumns, this->Info.vertexColumns);
  addKept(mesh.cellColumns, this->Info.cellColumns);
  if (this->AddIds)
  {
    this->Info.vertexColumns.push_back(IdSpec);
  }
  if (this->AddCellIds)
  {
    this->Info.cellColumns.push_back(CellIdSpec);
  }
  if (this->AddFlags)
  {
    this->Info.cellColumns.push_back({ CellFlagsName, ScalarType::UInt8, 1 });
  }
}

bool LayoutSource::next(MeshBlock& block)
{
  const std::size_t endCell = std::min(this->NextCell + BlockCells, this->Layout.cells.size());
  if (endCell == this->NextCell)
  {
    return false;
  }
  block.firstVertex = static_cast<std::int64_t>(this->NextVertex);
  block.firstCell = static_cast<std::int64_t>(this->NextCell);
  this->fillCells(block, endCell);
  const std::int64_t largest = *std::max_element(block.corners.begin(), block.corners.end());
  this->fillVertices(block, std::max(this->NextVertex, static_cast<std::size_t>(largest) + 1));
  this->NextCell = endCell;
  while (this->Finalized < this->NextVertex && this->Layout.lastCell[this->Finalized] < endCell)
  {
    ++this->Finalized;
  }
  block.finalized = static_cast<std::int64_t>(this->Finalized);
  return true;
}

void LayoutSource::fillVertices(MeshBlock& block, std::size_t end)
{
  const auto rows =
    std::span(this->Layout.vertices).subspan(this->NextVertex, end - this->NextVertex);
  block.positions.resize(rows.size() * 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    std::copy_n(
      this->Mesh.positions.data() + std::size_t(rows[i]) * 3, 3, block.positions.data() + i * 3);
  }
  block.vertexColumns.resize(this->Info.vertexColumns.size());
  std::size_t next = 0;
  for (const Column& column : this->Mesh.vertexColumns)
  {
    if (isKept(column.spec))
    {
      gatherTuples(column, rows, block.vertexColumns[next++]);
    }
  }
  if (this->AddIds)
  {
    number(IdSpec, rows, {}, block.vertexColumns[next]);
  }
  this->NextVertex = end;
}

void LayoutSource::fillCells(MeshBlock& block, std::size_t end)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Mesh.cellType));
  const auto rows = std::span(this->Layout.cells).subspan(this->NextCell, end - this->NextCell);
  block.corners.resize(rows.size() * corners);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (std::size_t k = 0; k < corners; ++k)
    {
      const std::int64_t vertex = this->Mesh.corners[rows[i] * corners + k];
      block.corners[i * corners + k] = this->Layout.streamIndex[static_cast<std::size_t>(vertex)];
    }
  }
  block.cellColumns.resize(this->Info.cellColumns.size());
  std::size_t next = 0;
  for (const Column& column : this->Mesh.cellColumns)
  {
    if (isKept(column.spec))
    {
      gatherTuples(column, rows, block.cellColumns[next++]);
    }
  }
  if (this->AddCellIds)
  {
    number(CellIdSpec, rows, this->Mesh.originalCells, block.cellColumns[next++]);
  }
  if (this->AddFlags)
  {
    Column& flags = block.cellColumns[next];
    flags.spec = { CellFlagsName, ScalarType::UInt8, 1 };
    flags.resize(rows.size());
    std::memcpy(flags.bytes.data(), this->Layout.flags.data() + this->NextCell, rows.size());
  }
}

} // namespace smg
