// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/VertexFile.h"
#include "Solver/Problem/BoundarySelection.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/Selection.h"
#include "smg/Export.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The vertices that a job holds: those of several parts of a mesh and, if it is fixed, of its
 * boundary. Evaluated block by block of the stream. */
class SMG_EXPORT FixedVertices
{
public:
  /** Throws Error if a part is not valid. `columns` must outlive this. `findsBoundary`: whether the
   * boundary is looked for. */
  FixedVertices(const std::vector<Where>& parts, bool findsBoundary, MeshColumns& columns);

  /** The bytes that are kept of open vertices, accounted for in MeshColumns::memory(). */
  std::int64_t bytes() const { return this->Memory.used(); }

  /** To be called with all blocks of the stream, followed by endPreparing(): see Selection. */
  void prepare(const MeshBlock& block, const std::filesystem::path& scratch);
  /** Throws Error if a part has no vertex. `fixesBoundary`: whether the boundary is held, too. */
  void endPreparing(bool fixesBoundary);
  /** Whether a boundary was found, after endPreparing(). */
  bool hasBoundary() const { return this->BoundarySize > 0; }

  /** For the vertices of the next block: 1 where held, else 0. The first block begins anew. */
  std::span<const std::uint8_t> at(const MeshBlock& block);

private:
  const Pool& Memory;
  Selections All;
  std::vector<const Selection*> Parts;         ///< null: everywhere
  std::unique_ptr<BoundarySelection> Boundary; ///< held after endPreparing(), if any
  std::int64_t BoundarySize = 0;               ///< vertices
  std::vector<std::uint8_t> Held;
};

/**
 * The vertices of the boundary, of a group, or of the cells with a tag or in a mask. They are found
 * in one pass over the mesh stream and can then be asked for in any order. An unnamed scratch file
 * has one bit for each vertex, of which 64 KiB are in memory.
 */
class SMG_EXPORT SelectedVertices
{
public:
  /** `where`: OnBoundary, InGroup, or a ColumnTag or ColumnMask of the cells. `name` is that of the
   * mesh in messages. Throws Error if the mesh has no such column. */
  SelectedVertices(const Where& where, const StreamInfo& mesh, const std::string& name);

  /** Adds the next block of the stream, which must have that column and, if the mesh has them, the
   * CellFlags. Throws Error if a value of a mask is not a number. */
  void add(const MeshBlock& block);
  /** To be called after the last block. Throws Error if there is no such vertex. */
  void finish();

  /** Whether the vertex with this stream index is one of them; after finish(). */
  bool contains(std::int64_t vertex) const;

private:
  MeshColumns Columns;
  Selections All;
  Selection* Selected;
  /** Of a selection that needs no preparation: its vertices. */
  mutable std::optional<VertexSetFile> Own;
};

} // namespace smg
