// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The moved positions of the vertices of a file, by their indices in the file. */
class MovedVertices
{
public:
  /** Reads the mesh stream `moved`, which has the column OriginalId, to its end. The last vertex of
   * a number replaces earlier ones. Throws Error; Cancelled. */
  MovedVertices(MeshSource& moved, Workspace& workspace, const ProgressFunction& progress = {});

  /**
   * Throws Error if the stream has a vertex that is not in the file `name` of `vertices` vertices.
   */
  void check(std::int64_t vertices, const std::string& name) const;
  /** Whether the stream had the column Normals of 3 components. */
  bool hasNormals() const { return this->Normals >= 0; }

  /** Finds a vertex, fast in ascending order. Returns false if it is not in the stream. Throws
   * Error. */
  bool find(std::int64_t vertex);
  /** Of the last vertex found. */
  std::span<const double, 3> position() const { return std::span(this->Values).first<3>(); }
  /** The same; only if there are normals. */
  std::span<const double, 3> normal() const { return std::span(this->Values).last<3>(); }

private:
  std::size_t numbers() const { return this->hasNormals() ? 6 : 3; }
  void put(const MeshBlock& block, RowSort& rows);
  void keep(RowSort& rows);

  std::ptrdiff_t Ids, Normals; ///< indices of the columns; -1: none
  BucketFile Rows;             ///< of each vertex, by number: the number, position and normal
  std::int64_t End = 0;        ///< the largest number, plus 1

  std::optional<BucketFile::Reader> Reader;
  std::int64_t Wanted = -1;   ///< the last vertex searched for
  std::int64_t Number = -1;   ///< of the last row read
  std::vector<double> Values; ///< of that row
};

} // namespace smg
