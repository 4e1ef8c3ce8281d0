// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/LayoutSource.h"

#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <cstring>
#include <span>

// A layout as a mesh stream. Vertices and cells are read in their order; the columns of the file,
// which are in the order of the file, are brought into the order of the stream by a join
// (ColumnJoin): pairs of number in the file and row, sorted by number, meet the tuples as they are
// read from the file, and the tuples go to a table by row. So each column is read once from first
// to last and written once, in bounded memory.

namespace smg
{

ColumnJoin::ColumnJoin(
  Workspace& workspace, const std::vector<RawColumn>& columns, std::int64_t memory)
  : Columns(columns)
  , Numbers(workspace, memory)
  , Space(workspace)
  , Memory(memory)
{
}

void ColumnJoin::join()
{
  std::size_t rowBytes = 0;
  std::vector<BucketFile::Reader> readers = readersOf(this->Columns, this->Space.available() / 4);
  for (const RawColumn& column : this->Columns)
  {
    rowBytes += column.spec.tupleBytes();
  }
  // One table for all columns: a row has the tuples of all.
  this->Rows.emplace(this->Space, this->NextRow, rowBytes, this->Memory * 3 / 4);
  this->Numbers.sort();
  const Buffer row(this->Space.pool(), rowBytes);
  std::int64_t read = -1; // the number whose tuples are in `row`
  for (Pair pair; this->Numbers.next(pair);)
  {
    // Tuples between the wanted ones are read and dropped. A number that occurs again finds its
    // tuples still there.
    for (; read < pair.number; ++read)
    {
      std::size_t at = 0;
      for (std::size_t c = 0; c < readers.size(); ++c)
      {
        const std::size_t bytes = this->Columns[c].spec.tupleBytes();
        readers[c].read(row.bytes().subspan(at, bytes));
        at += bytes;
      }
    }
    this->Rows->put(pair.row, row.bytes());
  }
  this->Rows->close();
}

void ColumnJoin::fill(std::int64_t rows, std::vector<Column>& columns)
{
  for (std::size_t c = 0; c < this->Columns.size(); ++c)
  {
    columns[c].spec = this->Columns[c].spec;
    columns[c].resize(static_cast<std::size_t>(rows));
  }
  // A read of the table ends with its bucket, so several may be needed.
  for (std::size_t done = 0; done < static_cast<std::size_t>(rows);)
  {
    const std::span<const std::byte> bytes =
      this->Rows->read(this->Filled, rows - static_cast<std::int64_t>(done));
    const std::size_t count = bytes.size() / this->Rows->rowBytes();
    std::size_t at = 0;
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::size_t tuple = this->Columns[c].spec.tupleBytes();
      std::byte* to = columns[c].bytes.data() + done * tuple;
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(to + i * tuple, bytes.data() + i * this->Rows->rowBytes() + at, tuple);
      }
      at += tuple;
    }
    done += count;
    this->Filled += static_cast<std::int64_t>(count);
  }
}

namespace
{

/** Adds the specs of the columns, and the spec of the original numbers if these are wanted and the
 * mesh does not have them. Returns whether it has added them. */
bool addSpecs(const std::vector<RawColumn>& columns, const ColumnSpec& numbers, bool wanted,
  std::vector<ColumnSpec>& specs)
{
  for (const RawColumn& column : columns)
  {
    specs.push_back(column.spec);
  }
  const bool add = wanted && findColumn(specs, numbers) < 0;
  if (add)
  {
    specs.push_back(numbers);
  }
  return add;
}

} // namespace

LayoutSource::LayoutSource(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, CellIds cellIds)
  : Mesh(mesh)
  , Layout(layout)
  , Vertices(layout.vertices, mesh.doublePositions)
  , Corners(layout.corners)
  , Elements(layout.elements)
  , Flags(layout.flags)
  , FacetGroups(layout.facetGroups)
  , BlockVertices(layout.blockVertices)
  , BlockFinalized(layout.blockFinalized)
  , BlockCells(StreamLayout::blockCells(mesh))
{
  this->Info.cellType = mesh.cellType;
  this->Info.vertices = layout.vertexCount;
  this->Info.cells = layout.cellCount;
  this->Info.doublePositions = mesh.doublePositions;
  this->AddIds = addSpecs(mesh.vertexColumns, OriginalIdSpec, true, this->Info.vertexColumns);
  this->AddElements = addSpecs(
    mesh.elementColumns, OriginalCellIdSpec, cellIds == WithCellIds, this->Info.cellColumns);
  this->Info.groups = layout.groups;
  if (this->FacetGroups.next(this->NextFacet))
  {
    this->Info.cellColumns.push_back(
      MeshGroups::columnSpec(GroupOf::Facets, cornersOf(mesh.cellType)));
  }
  if (layout.flags.size() > 0)
  {
    this->Info.cellColumns.push_back({ CellFlagsName, ScalarType::UInt8, 1 });
    // Only cells with flags are listed, by ascending cell: the reader is one ahead.
    this->Flags.next(this->NextFlag);
  }
  // Joined here, so that the stream is then read without a further sort.
  if (!mesh.vertexColumns.empty())
  {
    this->VertexJoin.emplace(workspace, mesh.vertexColumns, workspace.available() / 4);
    OrderedVertexReader vertices(layout.vertices, mesh.doublePositions);
    for (OrderedVertex<double> vertex; vertices.next(vertex);)
    {
      this->VertexJoin->put(vertex.id);
    }
    this->VertexJoin->join();
  }
  if (!mesh.elementColumns.empty())
  {
    this->CellJoin.emplace(workspace, mesh.elementColumns, workspace.available() / 4);
    RecordFile<std::uint32_t>::Reader elements(layout.elements);
    for (std::uint32_t element = 0; elements.next(element);)
    {
      this->CellJoin->put(element);
    }
    this->CellJoin->join();
  }
}

bool LayoutSource::next(MeshBlock& block)
{
  std::int64_t endVertex = 0;
  if (!this->BlockVertices.next(endVertex))
  {
    return false;
  }
  block.firstVertex = this->NextVertex;
  block.firstCell = this->NextCell;
  this->fillVertices(block, endVertex);
  this->fillCells(block, std::min(this->NextCell + this->BlockCells, this->Layout.cellCount));
  // The blocks are those that the assembly has counted.
  this->BlockFinalized.next(block.finalized);
  return true;
}

void LayoutSource::fillVertices(MeshBlock& block, std::int64_t end)
{
  const std::int64_t rows = end - this->NextVertex;
  block.positions.resize(static_cast<std::size_t>(rows) * 3);
  block.vertexColumns.resize(this->Info.vertexColumns.size());
  std::int64_t* ids = nullptr;
  if (this->AddIds)
  {
    Column& column = block.vertexColumns.back();
    column.spec = OriginalIdSpec;
    column.resize(static_cast<std::size_t>(rows));
    ids = column.as<std::int64_t>().data();
  }
  OrderedVertex<double> vertex;
  for (std::int64_t i = 0; i < rows && this->Vertices.next(vertex); ++i)
  {
    std::copy_n(vertex.position, 3, block.positions.begin() + 3 * i);
    if (ids)
    {
      ids[i] = vertex.id;
    }
  }
  if (this->VertexJoin)
  {
    this->VertexJoin->fill(rows, block.vertexColumns);
  }
  this->NextVertex = end;
}

void LayoutSource::fillCells(MeshBlock& block, std::int64_t end)
{
  const std::int64_t rows = end - this->NextCell;
  this->Numbers.resize(static_cast<std::size_t>(rows * cornersOf(this->Info.cellType)));
  this->Corners.next(std::span(this->Numbers));
  block.corners.assign(this->Numbers.begin(), this->Numbers.end());
  block.cellColumns.resize(this->Info.cellColumns.size());
  if (this->AddElements)
  {
    // The columns of the mesh come first, then the numbers, the facets, and the flags.
    Column& column = block.cellColumns[this->Mesh.elementColumns.size()];
    column.spec = OriginalCellIdSpec;
    column.resize(static_cast<std::size_t>(rows));
    this->Numbers.resize(static_cast<std::size_t>(rows));
    this->Elements.next(std::span(this->Numbers));
    std::copy(this->Numbers.begin(), this->Numbers.end(), column.as<std::int64_t>().begin());
  }
  if (this->CellJoin)
  {
    this->CellJoin->fill(rows, block.cellColumns);
  }
  if (this->Layout.facetGroups.size() > 0)
  {
    const std::size_t behind = this->Layout.flags.size() > 0 ? 2 : 1;
    Column& column = block.cellColumns[block.cellColumns.size() - behind];
    column.spec = MeshGroups::columnSpec(GroupOf::Facets, cornersOf(this->Info.cellType));
    column.bytes.assign(static_cast<std::size_t>(rows) * column.spec.tupleBytes(), std::byte(0));
    this->fillFacetGroups(column, end);
  }
  if (this->Layout.flags.size() > 0)
  {
    Column& column = block.cellColumns.back();
    column.spec = { CellFlagsName, ScalarType::UInt8, 1 };
    column.bytes.assign(static_cast<std::size_t>(rows), std::byte(0));
    this->fillFlags(column, end);
  }
  this->NextCell = end;
}

void LayoutSource::fillFacetGroups(Column& column, std::int64_t end)
{
  const std::span<GroupSet> sets = column.as<GroupSet>();
  while (this->NextFacet.cell < end)
  {
    const std::int64_t cell = this->NextFacet.cell - this->NextCell;
    sets[static_cast<std::size_t>(cell * column.spec.components) + this->NextFacet.facet] =
      this->NextFacet.set;
    if (!this->FacetGroups.next(this->NextFacet))
    {
      this->NextFacet.cell = NoIndex;
    }
  }
}

void LayoutSource::fillFlags(Column& column, std::int64_t end)
{
  // NoIndex is beyond every cell and ends the list.
  while (this->NextFlag.cell < end)
  {
    column.bytes[static_cast<std::size_t>(this->NextFlag.cell - this->NextCell)] =
      static_cast<std::byte>(this->NextFlag.flags);
    if (!this->Flags.next(this->NextFlag))
    {
      this->NextFlag.cell = NoIndex;
    }
  }
}

} // namespace smg
