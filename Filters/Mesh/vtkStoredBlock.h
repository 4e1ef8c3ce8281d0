// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Mesh/vtkPieceBlock.h"

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** A VTK mesh in memory as one block, with the arrays of these names, whatever columns are asked
 * for. */
class StoredBlock : public StoredMesh
{
public:
  /** As PieceBlock. */
  StoredBlock(vtkPointSet& mesh, std::set<std::string> names)
    : Block(mesh, std::move(names))
  {
  }

  const StreamInfo& info() const override { return this->Block.info(); }
  std::unique_ptr<MeshSource> source(std::vector<std::string> /*vertexColumns*/,
    std::vector<std::string> /*cellColumns*/) const override
  {
    return this->Block.source();
  }

private:
  PieceBlock Block;
};

} // namespace smg
