// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Motion/OriginalOrder.h"
#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Where the vertices of a file have moved to, by their places in the file. */
class MovedVertices
{
public:
  /**
   * Reads the mesh stream `moved`, which has the column OriginalId, to its end; see OriginalOrder
   * for `scratch` and `memory`. Throws Error; Cancelled.
   */
  MovedVertices(MeshSource& moved, const std::filesystem::path& scratch, std::int64_t memory,
    const ProgressFunction& progress = {});

  /** Throws Error if the stream has a vertex that the file `name` of `vertices` vertices has not.
   */
  void check(std::int64_t vertices, const std::string& name) const;
  /** Whether the stream had the column Normals of 3 components. */
  bool hasNormals() const { return this->Normals >= 0; }

  /** Goes to a vertex: quick for ascending ones. False: it is not in the stream. Throws Error. */
  bool find(std::int64_t vertex);
  /** Of the vertex found last. */
  std::span<const double, 3> position() const { return this->Found.first<3>(); }
  /** The same; only if there are normals. */
  std::span<const double, 3> normal() const { return this->Found.last<3>(); }

private:
  std::size_t numbers() const { return this->hasNormals() ? 6 : 3; }
  void put(const MeshBlock& block);

  std::ptrdiff_t Ids, Normals; ///< places of the columns; -1: there is none
  OriginalOrder Order;
  std::int64_t First = 0;          ///< the vertex that the values read last begin with
  std::vector<std::uint8_t> Given; ///< of these: whether they are in the stream
  std::vector<double> Values;
  std::span<const double> Found;
};

} // namespace smg
