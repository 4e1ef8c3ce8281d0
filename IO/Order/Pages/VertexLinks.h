// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Order/Pages/CellGroups.h"
#include "Solver/Memory/Buffer.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/**
 * The links of a range of vertices: for each of the cells around a vertex the ranks of the cell's
 * other corners, that is, the edges opposite to it in triangles, or the faces in tetrahedra.
 */
class VertexLinks
{
public:
  /** Counts the cells around each vertex of the range, all of which are in the group. */
  VertexLinks(Workspace& workspace, const CellGroups& groups, int group, std::size_t corners);

  /** The number of ranks in the links of the vertices of a part of the range. */
  std::int64_t size(RankRange part) const;
  std::int64_t size() const { return this->size(this->Range); }
  /** The number of ranks in the largest link. */
  std::size_t largest() const { return this->Largest; }
  /** Bytes that load() allocates. */
  std::int64_t bytes() const { return this->size() * std::int64_t(sizeof(std::uint32_t)); }

  /** Collects the links. */
  void load(Workspace& workspace, const CellGroups& groups, int group);

  std::span<const std::uint32_t> of(std::uint32_t vertex) const
  {
    const std::size_t place = vertex - static_cast<std::uint32_t>(this->Range.begin);
    const std::uint64_t* begins = this->begins();
    return { this->ranks() + begins[place],
      static_cast<std::size_t>(begins[place + 1] - begins[place]) };
  }

private:
  std::uint64_t* begins() const { return reinterpret_cast<std::uint64_t*>(this->Begins.data()); }
  std::uint32_t* ranks() const { return reinterpret_cast<std::uint32_t*>(this->Ranks.data()); }

  RankRange Range;
  std::size_t Corners;
  std::size_t Largest = 0;
  Buffer Begins; ///< of the links, and the end of the last
  Buffer Ranks;
};

} // namespace smg
