// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/BoundarySelection.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/Selection.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The vertices of several parts of a mesh, and of its boundary if that is fixed, block by block of
 * the stream. */
class HeldVertices
{
public:
  /** Throws Error if a part is not valid. `columns` must outlive this. `findsBoundary`: whether the
   * boundary is looked for. */
  HeldVertices(const std::vector<Where>& parts, bool findsBoundary, MeshColumns& columns);

  /** The bytes that are kept of open vertices, accounted for in MeshColumns::memory(). */
  std::int64_t bytes() const { return this->Memory.used(); }

  /** To be called with all blocks of the stream, followed by endPreparing(): see Selection. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Throws Error if a part has no vertex. `fixesBoundary`: whether the boundary is held, too. */
  void endPreparing(bool fixesBoundary);
  /** Whether a boundary was found, after endPreparing(). */
  bool hasBoundary() const { return this->BoundarySize > 0; }

  /** For the vertices of the next block: 1 where held, else 0. The first block restarts it. */
  std::span<const std::uint8_t> at(const MeshBlock& block);

private:
  const Pool& Memory;
  bool HoldsAll = false;
  std::vector<std::unique_ptr<Selection>> Parts;
  std::unique_ptr<BoundarySelection> Boundary; ///< held after endPreparing(), if any
  std::int64_t BoundarySize = 0;               ///< vertices
  std::vector<std::uint8_t> Held;
};

} // namespace smg
