// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Order/StreamLayout.h"
#include "Solver/Stream/MeshSource.h"

namespace smg
{

/**
 * Delivers a mesh in memory as a mesh stream. The stream has the mesh's columns, the places of
 * vertices and cells in the mesh's file (OriginalId and OriginalCellId, unless the mesh has them
 * already), and CellFlags if any cell has a flag.
 */
class LayoutSource : public MeshSource
{
public:
  enum CellIds
  {
    WithCellIds,
    WithoutCellIds ///< OriginalCellId is not added: the order of the mesh's cells means nothing
  };

  /** Mesh and layout must live as long as the source. */
  LayoutSource(const IndexedMesh& mesh, const StreamLayout& layout, CellIds cellIds = WithCellIds);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

private:
  void fillVertices(MeshBlock& block, std::size_t end);
  void fillCells(MeshBlock& block, std::size_t end);

  const IndexedMesh& Mesh;
  const StreamLayout& Layout;
  StreamInfo Info;
  bool AddIds = true;
  bool AddCellIds = true;
  bool AddFlags = false;
  std::size_t NextVertex = 0;
  std::size_t NextCell = 0;
  std::size_t Finalized = 0;
};

} // namespace smg
