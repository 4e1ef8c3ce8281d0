// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/PageBuilder.h"
#include "IO/Order/Pages/RankedVertices.h"
#include "IO/Order/Pages/VertexStar.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** The number of vertices of a group of cells, whole pages: such that the links of a group fit into
 * a share of `memory`, and mostly into the cache of a processor, and at least so large that all
 * groups can be collected in `collecting` bytes. */
std::int64_t groupVertices(std::int64_t vertices, std::int64_t cells, std::size_t corners,
  int pageVertices, std::int64_t memory, std::int64_t collecting);

/** Makes the pages of a mesh, group by group, and the counts. */
template <class Real>
class GroupPages
{
public:
  /** Mesh, workspace and vertices must outlive this object. */
  GroupPages(const RawMesh& mesh, Workspace& workspace,
    const RecordFile<RankedVertex<Real>>& vertices, int pageVertices);

  /** Appends the pages of all groups, of several at once if they certainly fit into the memory. */
  void append(const CellGroups& groups);

  /** Appends the pages of the next group. A group that does not fit into the memory is split;
   * throws Error if a page does not. */
  void append(const CellGroups& groups, int group);

  /** To be called after the last append(). */
  PagedMesh finish();

private:
  std::int64_t largestPage(const VertexLinks& links, RankRange range) const;
  void split(const CellGroups& groups, int group, std::int64_t parts);
  std::size_t groupsAtOnce(const CellGroups& groups) const;
  void append(const GroupStars& stars);
  /** around(vertex) returns the neighbours of a vertex. */
  template <class Around>
  void appendPage(RankRange page, Around&& around);

  Workspace& Space;
  std::size_t Corners;
  typename RecordFile<RankedVertex<Real>>::Reader Vertices;
  std::vector<VertexPages::Vertex> Page;
  std::int64_t Edges = 0, Crossing = 0; ///< directed
  PagedMesh Result;
};

} // namespace smg
