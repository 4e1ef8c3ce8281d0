// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SeamVertices.h"
#include "Solver/Problem/FixedVertices.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** A mesh stream with its columns and one more, the last one of the vertices (uint8): 1 where they
 * are held, the number of vertices at their place where they lie on seams, else 0; see
 * SurfacePart::marksHeld. Without the column where that would be 0 for all. */
class HeldMesh : public MeshSource
{
public:
  /** Reads the mesh once, to find what is held and, of triangles, the seams; `memory` limits what
   * is remembered of it, in bytes. Throws Error if a part is not valid or has no vertex. */
  HeldMesh(const StoredMesh& mesh, const std::vector<Where>& parts, std::int64_t memory,
    const std::filesystem::path& scratch, const ProgressFunction& progress);

  const StreamInfo& info() const override { return this->Mesh->info(); }
  bool next(MeshBlock& block) override { return this->Mesh->next(block); }

  /** Whether there is the column. */
  bool marksHeld() const { return this->Marks; }
  /** The places of seams, which an estimate tells if not all are marked. */
  std::int64_t seams() const { return this->SeamPlaces; }
  bool marksSeams() const { return !this->Seams.empty(); }
  /** The vertices held in the blocks that were delivered. */
  std::int64_t held() const { return this->Count; }
  /** The bytes that are kept. */
  std::int64_t bytes() const { return this->Columns.memory().used(); }
  std::int64_t peakMemory() const { return this->Columns.memory().peak(); }

private:
  void mark(const MeshBlock& block, std::span<std::uint8_t> marks);

  MeshColumns Columns;
  FixedVertices Vertices;
  std::unique_ptr<MeshSource> Mesh;
  bool Holds, Marks = false;
  std::vector<SeamVertices::Seam> Seams; ///< if all are known
  std::int64_t SeamPlaces = 0;
  std::int64_t Count = 0;
};

/** Parts of a mesh as a text, another one for other parts. */
std::string textOf(const std::vector<Where>& parts);

} // namespace smg
