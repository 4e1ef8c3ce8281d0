// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/MeshCounts.h"
#include "IO/Order/Pages/VertexLinks.h"
#include "IO/Order/Pages/VertexStar.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Adds what is around a vertex of triangles to the counts. */
inline void addCounts(const VertexStar& star, MeshCounts& counts)
{
  counts.boundaryEdges += star.boundaryEdges();
  counts.nonManifoldEdges += star.nonManifoldEdges();
  counts.nonManifoldVertices += star.fans() > 1;
}

/** The neighbours of the vertices of a group of cells, and the counts of triangles around them. */
class GroupStars
{
public:
  GroupStars(Workspace& workspace, const CellGroups& groups, int group, std::size_t corners);

  /** An upper bound of its memory in bytes while it is made, for a group of so many vertices and
   * cells. */
  static std::int64_t mostBytes(std::int64_t vertices, std::int64_t cells, std::size_t corners);

  RankRange range() const { return this->Range; }
  /** The neighbours of a vertex of the range, see VertexStar::visit(). */
  std::span<const std::uint32_t> neighbours(std::uint32_t vertex) const
  {
    const auto* ends = reinterpret_cast<const std::uint64_t*>(this->Ends.data()) +
                       (vertex - static_cast<std::uint32_t>(this->Range.begin));
    return { reinterpret_cast<const std::uint32_t*>(this->Ranks.data()) + ends[0],
      static_cast<std::size_t>(ends[1] - ends[0]) };
  }
  /** Of triangles: boundary and non-manifold edges and vertices; 0 for others. */
  const MeshCounts& counts() const { return this->Counts; }

private:
  RankRange Range;
  Buffer Ends; ///< of the neighbours of each vertex, after a 0
  Buffer Ranks;
  MeshCounts Counts;
};

} // namespace smg
