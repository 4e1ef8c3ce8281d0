// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg::testing
{

/**
 * Delivers a StreamMesh in blocks of a given number of cells. Vertices that no cell uses, which
 * streams do not have else, may follow the others.
 */
class MemorySource : public MeshSource
{
public:
  explicit MemorySource(StreamMesh mesh, std::int64_t blockCells = 1000);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

  /** Begins again, for the next solve, with blocks of `blockCells` cells. */
  void rewind(std::int64_t blockCells);

  const StreamMesh& mesh() const { return this->Mesh; }

private:
  void measure();

  StreamMesh Mesh;
  StreamInfo Info;
  std::int64_t BlockCells;
  std::vector<std::int64_t> NewVertices; ///< of each cell: vertices introduced up to its end
  std::vector<std::int64_t> Finalized;   ///< of each cell: MeshBlock::finalized after it
  std::int64_t NextCell = 0;
  std::int64_t NextVertex = 0;
};

} // namespace smg::testing
