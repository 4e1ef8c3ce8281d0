// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg::testing
{

/** Delivers a StreamMesh in blocks of a given number of cells. Unlike in other streams, vertices
 * that no cell uses may follow the others. */
class MemorySource : public MeshSource
{
public:
  explicit MemorySource(StreamMesh mesh, std::int64_t blockCells = 1000);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;
  bool readsOnAnyThread() const override { return true; }

  /** Restarts, for the next solve, with blocks of `blockCells` cells. */
  void rewind(std::int64_t blockCells);

  const StreamMesh& mesh() const { return this->Mesh; }

private:
  void measure();

  StreamMesh Mesh;
  StreamInfo Info;
  std::int64_t BlockCells;
  std::vector<std::int64_t> NewVertices; ///< vertices introduced up to the end of each cell
  std::vector<std::int64_t> Finalized;   ///< MeshBlock::finalized after each cell
  std::int64_t NextCell = 0;
  std::int64_t NextVertex = 0;
};

} // namespace smg::testing
