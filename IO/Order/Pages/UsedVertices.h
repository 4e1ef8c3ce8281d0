// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Import/RawMesh.h"
#include "Solver/Memory/Buffer.h"

#include <cstdint>

namespace smg
{

/** Determines which vertices of a mesh are in a cell: a bit per vertex, for as many vertices at a
 * time as the memory permits, with a pass over the cells each time. */
class UsedVertices
{
public:
  /** The bits use at most `memory` bytes. Mesh and workspace must outlive this object. */
  UsedVertices(const RawMesh& mesh, Workspace& workspace, std::int64_t memory);

  /**
   * Vertices should be queried in ascending order: a step back may require a pass over the cells.
   */
  bool contains(std::uint32_t vertex)
  {
    if (std::int64_t(vertex) - this->First >= this->Range || vertex < this->First)
    {
      this->load(vertex);
    }
    const auto place = static_cast<std::uint32_t>(vertex - this->First);
    return (this->words()[place / 64] >> place % 64 & 1) != 0;
  }

private:
  void load(std::uint32_t vertex);
  std::uint64_t* words() const { return reinterpret_cast<std::uint64_t*>(this->Bits.data()); }

  const RawMesh& Mesh;
  std::int64_t Range;
  std::int64_t First; ///< the first vertex of the bits
  Buffer Bits;
};

} // namespace smg
