// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmSource.h"

#include <algorithm>

namespace smg
{

VsmSource::VsmSource(const std::filesystem::path& path,
  const std::vector<std::string>& vertexColumns, const std::vector<std::string>& cellColumns,
  IoStatistics* statistics)
  : File(path, statistics)
  , Info(this->File.Info)
  , Positions(this->File)
{
  this->Info.vertexColumns.clear();
  for (const std::string& name : vertexColumns)
  {
    const int column = this->File.vertexColumn(name);
    this->VertexColumns.emplace_back(this->File.Blocks, VsmFormat::Vertices, column);
    this->Info.vertexColumns.push_back(this->File.Info.vertexColumns[column - 1]);
  }
  this->Info.cellColumns.clear();
  for (const std::string& name : cellColumns)
  {
    const int column = this->File.cellColumn(name);
    this->CellColumns.emplace_back(this->File.Blocks, VsmFormat::Cells, column);
    this->Info.cellColumns.push_back(this->File.Info.cellColumns[column - 1]);
  }
  this->prefetch(0);
}

/** Requests a block of the cells and the vertices that it introduces. */
void VsmSource::prefetch(std::int64_t block)
{
  BlockFileReader& blocks = this->File.Blocks;
  if (block >= this->File.cellBlocks())
  {
    return;
  }
  blocks.prefetch(VsmFormat::Cells, block);
  const std::int64_t end = this->File.firstVertex(block + 1);
  while (this->PrefetchedVertex < blocks.blocks(VsmFormat::Vertices) &&
         blocks.firstRow(VsmFormat::Vertices, this->PrefetchedVertex) < end)
  {
    blocks.prefetch(VsmFormat::Vertices, this->PrefetchedVertex++);
  }
}

void VsmSource::readColumns(std::vector<RowReader>& readers, const std::vector<ColumnSpec>& specs,
  std::int64_t first, std::int64_t count, std::vector<Column>& columns)
{
  columns.resize(specs.size());
  for (std::size_t c = 0; c < specs.size(); c++)
  {
    columns[c].spec = specs[c];
    columns[c].resize(count);
    readers[c].read(first, count, columns[c].bytes.data());
  }
}

bool VsmSource::next(MeshBlock& block)
{
  if (this->Next >= this->File.cellBlocks())
  {
    return false;
  }
  const std::int64_t b = this->Next++;
  this->prefetch(b + 1);
  this->File.readCorners(b, block.corners);
  block.firstCell = this->File.Blocks.firstRow(VsmFormat::Cells, b);
  const std::int64_t cells = this->File.Blocks.blockRows(VsmFormat::Cells, b);
  this->readColumns(
    this->CellColumns, this->Info.cellColumns, block.firstCell, cells, block.cellColumns);

  block.firstVertex = this->File.firstVertex(b);
  const std::int64_t vertices = this->File.firstVertex(b + 1) - block.firstVertex;
  block.positions.resize(3 * vertices);
  this->Positions.read(block.firstVertex, vertices, block.positions.data());
  this->readColumns(this->VertexColumns, this->Info.vertexColumns, block.firstVertex, vertices,
    block.vertexColumns);
  block.finalized = this->File.finalized(b);
  return true;
}

} // namespace smg
