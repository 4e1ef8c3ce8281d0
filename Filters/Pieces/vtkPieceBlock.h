// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <memory>
#include <set>
#include <string>

class vtkPointSet;

namespace smg
{

/**
 * A piece of a mesh, or a preview, as a mesh stream of one block, whose vertices are the points of
 * the piece in their order. Its columns are the existing arrays of the given names, and the
 * original ids of its points and cells.
 */
class PieceBlock
{
public:
  /** `names` are those of the arrays. The piece must have cells. Throws Error if these are neither
   * triangles nor tetrahedra. */
  PieceBlock(vtkPointSet& piece, std::set<std::string> names);

  const StreamInfo& info() const { return this->Info; }
  const MeshBlock& block() const { return this->Block; }
  /** The stream. */
  std::unique_ptr<MeshSource> source() const;

private:
  StreamInfo Info;
  MeshBlock Block;
};

} // namespace smg
