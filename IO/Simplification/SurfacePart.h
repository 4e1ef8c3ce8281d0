// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/Quadric.h"
#include "smg/Column.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Triangles of a surface with their vertices, in a numbering of their own. */
struct SurfacePart
{
  std::vector<std::int64_t> ids; ///< stream indices of the vertices, each once
  std::vector<double> points;    ///< x, y, z of each vertex
  /** Of each vertex: the planes of the triangles that were there and at vertices that have
   * collapsed onto it, for points relative to `origin`. */
  std::vector<Quadric> quadrics;
  std::array<double, 3> origin{};
  /** Of each vertex, with quadrics: not 0 if those of its boundary edges may be missing. */
  std::vector<std::uint8_t> lacksBoundary;
  std::vector<std::byte> rows;        ///< of each vertex, its tuples of all columns one by one
  std::vector<std::uint32_t> corners; ///< places in `ids`, three a triangle

  std::size_t vertices() const { return this->ids.size(); }
  std::size_t triangles() const { return this->corners.size() / 3; }
  /** The bytes of the row of a vertex. */
  std::size_t rowBytes() const
  {
    return this->ids.empty() ? 0 : this->rows.size() / this->vertices();
  }

  /** Appends a vertex of another surface, without its quadric. */
  void addVertex(const SurfacePart& from, std::size_t vertex);
  /** Appends the position and the tuples of a vertex to these. */
  void copyVertex(
    std::size_t vertex, std::vector<double>& positions, std::span<Column> columns) const;
  /** Some triangles of this surface with their vertices, without quadrics. */
  SurfacePart extract(const std::vector<std::uint32_t>& some) const;
  /** Removes the vertices that no triangle uses; the others keep their order. */
  void dropUnusedVertices();

  template <class State>
  void exchange(State& state)
  {
    state(this->ids, this->points, this->quadrics, this->origin, this->lacksBoundary, this->rows,
      this->corners);
  }
};

} // namespace smg
