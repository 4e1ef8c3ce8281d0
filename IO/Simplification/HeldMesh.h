// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/FixedVertices.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** A mesh stream with all columns and one more, the last one of the vertices (uint8): not 0 where
 * they are held. */
class HeldMesh : public MeshSource
{
public:
  /** Reads the mesh once, to find what is held; `memory` limits what is remembered of it, in bytes.
   * Throws Error if a part is not valid or has no vertex. */
  HeldMesh(const StoredMesh& mesh, const std::vector<Where>& parts, std::int64_t memory,
    const std::filesystem::path& scratch, const ProgressFunction& progress);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

  /** The vertices held in the blocks that were delivered. */
  std::int64_t held() const { return this->Count; }
  /** The bytes that are kept. */
  std::int64_t bytes() const { return this->Columns.memory().used(); }
  std::int64_t peakMemory() const { return this->Columns.memory().peak(); }

private:
  MeshColumns Columns;
  FixedVertices Vertices;
  std::unique_ptr<MeshSource> Mesh;
  StreamInfo Info;
  std::int64_t Count = 0;
};

/** Parts of a mesh as a text, another one for other parts. */
std::string textOf(const std::vector<Where>& parts);

} // namespace smg
