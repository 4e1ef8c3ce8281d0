// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/** Brings the columns of a file into the order of a stream: put() sets the number in the file of
 * each row of the stream, row by row; fill() delivers the tuples of the rows. Numbers may be
 * repeated. */
class ColumnJoin
{
public:
  /** The columns must outlive this object. Uses about `memory` bytes of the pool, twice that in
   * join(). */
  ColumnJoin(Workspace& workspace, const std::vector<RawColumn>& columns, std::int64_t memory);

  /** Sets the number of the next row. */
  void put(std::uint32_t number) { this->Numbers.put({ number, this->NextRow++ }); }

  /** Sorts the tuples by rows, after the last put(). */
  void join();

  /** Fills the first columns of `columns` with the tuples of the next `rows` rows. */
  void fill(std::int64_t rows, std::vector<Column>& columns);

private:
  struct Pair
  {
    std::uint32_t number;
    std::uint32_t row;
    auto operator<=>(const Pair&) const = default;
  };

  const std::vector<RawColumn>& Columns;
  std::uint32_t NextRow = 0;
  ExternalSort<Pair> Numbers;
  std::optional<RowTable> Rows;
  std::int64_t Filled = 0; ///< rows
  Workspace& Space;
  std::int64_t Memory;
};

/** Delivers a layout as a mesh stream. It has the columns of the mesh, the indices of vertices and
 * cells in the file (OriginalId and OriginalCellId, unless the mesh already has them),
 * FacetGroups if any facet is in a group, and CellFlags if any cell has a flag. */
class LayoutSource : public MeshSource
{
public:
  enum CellIds
  {
    WithCellIds,
    WithoutCellIds ///< without OriginalCellId, as the order of the cells is irrelevant
  };

  /** Mesh and layout must outlive the source. */
  LayoutSource(const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace,
    CellIds cellIds = WithCellIds);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

private:
  void fillVertices(MeshBlock& block, std::int64_t end);
  void fillCells(MeshBlock& block, std::int64_t end);
  void fillFlags(Column& column, std::int64_t end);
  void fillFacetGroups(Column& column, std::int64_t end);

  const RawMesh& Mesh;
  const StreamLayout& Layout;
  StreamInfo Info;
  bool AddIds = true;
  bool AddElements = true;
  std::optional<ColumnJoin> VertexJoin, CellJoin;
  OrderedVertexReader Vertices;
  RecordFile<std::uint32_t>::Reader Corners, Elements;
  RecordFile<FlaggedCell>::Reader Flags;
  RecordFile<GroupedFacet>::Reader FacetGroups;
  RecordFile<std::int64_t>::Reader BlockVertices, BlockFinalized;
  std::int64_t BlockCells;
  FlaggedCell NextFlag{ NoIndex, 0 };
  GroupedFacet NextFacet{ NoIndex, 0, 0 };
  std::int64_t NextVertex = 0;
  std::int64_t NextCell = 0;
  std::vector<std::uint32_t> Numbers;
};

} // namespace smg
