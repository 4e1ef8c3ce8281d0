// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "IO/Simplification/SolidBoundary.h"
#include "IO/Simplification/StreamSimplifier.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Simplify.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <unordered_map>

namespace smg
{

/** A simplified surface as a mesh stream, with the vertex columns of the mesh, and with OriginalId,
 * the stream index in the mesh, if the mesh has no such column; with the cell columns of a mesh of
 * triangles (carriedColumns()). Its counts are known only at its
 * end. */
class SMG_EXPORT SimplifiedMesh : public MeshSource
{
public:
  /** `mesh` and `workers` must outlive it; see StreamSimplifier. With `marksHeld`, the last column
   * of the vertices is not in the result. */
  SimplifiedMesh(MeshSource& mesh, bool marksHeld, const SimplifyTarget& target,
    std::int64_t memory, Workers& workers, std::function<void(double)> progress);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

  StreamSimplifier& simplifier() { return this->Simplifier; }

private:
  void addVertex(std::size_t vertex, MeshBlock& block);

  SolidBoundary Surface;
  StreamSimplifier Simplifier;
  StreamInfo Info;
  bool AddsIds;
  StreamSimplifier::Result Part;
  /** Numbers in this stream of vertices that later parts may have. */
  std::unordered_map<std::int64_t, std::int64_t> Numbers;
};

/** Throws Error unless simplify() can write a file of this name. */
SMG_EXPORT void checkSimplifiedPath(const std::filesystem::path& path);

/** The expected cost of simplify() of `mesh` to the file `out`; without a limit of the vertices,
 * for a result as large as the mesh. Of `conversion` only the folder for scratch files counts.
 * Throws Error if the options are not valid. */
SMG_EXPORT JobEstimate simplifyEstimate(const EstimatedInput& mesh, const SimplifyTarget& target,
  const std::filesystem::path& out, const SimplifyOptions& options,
  const ConversionOptions& conversion);

} // namespace smg
