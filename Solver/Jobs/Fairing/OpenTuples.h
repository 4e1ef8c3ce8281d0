// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Memory/Ring.h"
#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/** The tuples of a vertex file at the open vertices of a mesh stream. Blocks are passed in order;
 * the first block restarts it. */
class OpenTuples
{
public:
  OpenTuples(Pool& pool, const VertexFile& file)
    : File(&file)
    , Values(pool, file.lanes())
  {
  }

  /** Reads the tuples of the vertices of the next block. */
  void startBlock(const MeshBlock& block)
  {
    if (block.firstVertex == 0)
    {
      this->Values.restart();
      this->Finalized = 0;
    }
    this->Values.release(this->Finalized);
    this->Finalized = block.finalized;
    if (block.vertices() > 0)
    {
      this->Values.extendRaw(block.firstVertex + block.vertices());
      this->File->read(block.firstVertex, block.vertices(), this->Values.at(block.firstVertex));
    }
  }

  /** The tuple of an open vertex; those of the current block lie one after the other. */
  const double* at(std::int64_t vertex) const { return this->Values.at(vertex); }

private:
  const VertexFile* File;
  Ring<double> Values;
  std::int64_t Finalized = 0; ///< after the previous block
};

} // namespace smg
