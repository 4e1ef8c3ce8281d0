// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Restores a polygon from its triangles. The polygon c0 c1 c2 ... was split into the fan of
 * triangles c0 c1 c2, c0 c2 c3 ..., given in any order: from c1 on, the corners are the trail that
 * uses the last two corners of each triangle once, as an edge. If corners of the polygon are
 * repeated, several polygons may have the same triangles; the result is one of these.
 */
class FanChain
{
public:
  /** Whether the triangles, 3 corners each, are such a fan; then polygon() returns its corners. */
  bool build(std::span<const std::uint32_t> triangles);

  std::span<const std::uint32_t> polygon() const { return this->Corners; }

private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  bool findStart(std::uint32_t& start) const;
  void walk(std::uint32_t start);

  std::vector<std::uint32_t> Corners;
  std::vector<Edge> Edges;                 ///< by their first corner
  std::vector<std::uint32_t> Ends;         ///< the edges' last corners, ascending
  std::vector<std::size_t> Taken;          ///< by the first edge of a corner: how many of its edges
  std::vector<std::uint32_t> Stack, Trail; ///< the trail from its end to its start
};

} // namespace smg
