// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Vtk/PieceColumns.h"
#include "smg/MeshSource.h"

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

/** Delivers a mesh in one block. */
class OneBlockSource : public MeshSource
{
public:
  OneBlockSource(StreamInfo info, MeshBlock block)
    : Info(std::move(info))
    , Block(std::move(block))
  {
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    if (std::exchange(this->IsDone, true))
    {
      return false;
    }
    block = std::move(this->Block);
    return true;
  }

private:
  StreamInfo Info;
  MeshBlock Block;
  bool IsDone = false;
};

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
