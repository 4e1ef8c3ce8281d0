// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"
#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/ColumnJoin.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "smg/MeshSource.h"

#include <optional>

namespace smg
{

/**
 * Delivers a layout as a mesh stream. The stream has the columns of the mesh, the indices of
 * vertices and cells in its file (OriginalId and OriginalCellId, unless the mesh already has them),
 * and CellFlags if any cell has a flag.
 */
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

  const RawMesh& Mesh;
  const StreamLayout& Layout;
  StreamInfo Info;
  bool AddIds = true;
  bool AddElements = true;
  std::optional<ColumnJoin> VertexJoin, CellJoin;
  OrderedVertexReader Vertices;
  RecordFile<std::uint32_t>::Reader Corners, Elements;
  RecordFile<FlaggedCell>::Reader Flags;
  RecordFile<std::int64_t>::Reader BlockVertices, BlockFinalized;
  FlaggedCell NextFlag{ NoIndex, 0 };
  std::int64_t NextVertex = 0;
  std::int64_t NextCell = 0;
  std::vector<std::uint32_t> Numbers;
};

} // namespace smg
