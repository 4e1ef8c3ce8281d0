// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/GroupStars.h"

namespace smg
{

GroupStars::GroupStars(
  Workspace& workspace, const CellGroups& groups, int group, std::size_t corners)
  : Range(groups.range(group))
  , Ends(workspace.pool(), static_cast<std::size_t>(this->Range.size() + 1) * sizeof(std::uint64_t))
{
  this->Counts.boundaryEdges = this->Counts.nonManifoldEdges = 0;
  this->Counts.nonManifoldVertices = 0;
  VertexLinks links(workspace, groups, group, corners);
  links.load(workspace, groups, group);
  VertexStar star(workspace, this->Range, links.largest());
  this->Ranks = Buffer(workspace.pool(), static_cast<std::size_t>(links.bytes()));
  const std::span ranks(
    reinterpret_cast<std::uint32_t*>(this->Ranks.data()), static_cast<std::size_t>(links.size()));
  auto* ends = reinterpret_cast<std::uint64_t*>(this->Ends.data());
  std::uint64_t end = *ends = 0;
  for (std::int64_t rank = this->Range.begin; rank < this->Range.end; ++rank)
  {
    const auto vertex = static_cast<std::uint32_t>(rank);
    end += star.visit(vertex, links.of(vertex), corners, ranks.subspan(end));
    *++ends = end;
    if (corners == 3)
    {
      addCounts(star, this->Counts);
    }
  }
}

std::int64_t GroupStars::mostBytes(std::int64_t vertices, std::int64_t cells, std::size_t corners)
{
  const auto links = static_cast<std::int64_t>(corners * (corners - 1)) * cells;
  // Both have ends, links and neighbours have ranks; a buffer is rounded up, a reader has a chunk.
  return 2 * (vertices + 1) * std::int64_t(sizeof(std::uint64_t)) +
         2 * links * std::int64_t(sizeof(std::uint32_t)) +
         VertexStar::bytes(vertices, static_cast<std::size_t>(links)) +
         std::int64_t(BucketFile::ChunkBytes) + 1024;
}

} // namespace smg
