// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/vtkPieceBlock.h"
#include "IO/vtkPieceColumns.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace smg
{

/** A VTK mesh in memory as one block, with the arrays of these names, whatever columns are asked
 * for. */
class StoredBlock : public StoredMesh
{
public:
  /** Throws Error if the mesh lacks one of the arrays. */
  StoredBlock(vtkPointSet& mesh, const std::set<std::string>& names)
    : Block(checked(mesh, names), names)
  {
  }

  const StreamInfo& info() const override { return this->Block.info(); }
  std::unique_ptr<MeshSource> source(std::vector<std::string> /*vertexColumns*/,
    std::vector<std::string> /*cellColumns*/) const override
  {
    return this->Block.source();
  }

private:
  static vtkPointSet& checked(vtkPointSet& mesh, const std::set<std::string>& names)
  {
    requireArrays(mesh, names);
    return mesh;
  }

  PieceBlock Block;
};

} // namespace smg
