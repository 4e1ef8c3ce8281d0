// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/GroupPages.h"

#include "Solver/Core/Text.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

// The pages of a mesh from its cells, group by group. A group consists of consecutive pages, as
// many as have links that fit into a share of the memory. Several groups are treated on different
// threads if they certainly fit; their pages are appended in order, so the file does not depend on
// the number of threads. A group that does not fit, as around a vertex of very many cells, is split
// into smaller ones.

namespace smg
{

namespace
{

constexpr std::int64_t SampledVertices = 16384;
/** The bytes of a group's links above which scattering exceeds the processor's cache. */
constexpr std::int64_t CachedBytes = std::int64_t(4) << 20;
/** The minimum memory for collecting a group of cells. */
constexpr std::int64_t CollectedBytes = std::int64_t(16) << 10;
/** The memory for readers and for the file of the pages. */
constexpr std::int64_t Reserve = std::int64_t(1) << 20;
/** The maximum bytes of VertexPages per neighbour while a page is made. */
constexpr std::int64_t EncodedBytes = 5;

std::int64_t roundUp(std::int64_t count, std::int64_t unit)
{
  return (count + unit - 1) / unit * unit;
}

float toFloat(double value)
{
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -most, most));
}

} // namespace

std::int64_t groupVertices(std::int64_t vertices, std::int64_t cells, std::size_t corners,
  int pageVertices, std::int64_t memory, std::int64_t collecting)
{
  // Each corner of a cell has the other corners in its link.
  const auto linkBytes = static_cast<std::int64_t>(corners * (corners - 1) * sizeof(std::uint32_t));
  const std::int64_t vertexBytes = 12 + cells * linkBytes / std::max<std::int64_t>(1, vertices);
  const std::int64_t most = std::min(memory / 5, CachedBytes) / vertexBytes;
  const std::int64_t groups = std::max<std::int64_t>(1, collecting / CollectedBytes);
  // Enough vertices to keep the number of groups within what can be collected at once, in whole
  // pages.
  return roundUp(std::max({ most, vertices / groups, std::int64_t(pageVertices) }), pageVertices);
}

template <class Real>
GroupPages<Real>::GroupPages(const RawMesh& mesh, Workspace& workspace,
  const RecordFile<RankedVertex<Real>>& vertices, int pageVertices)
  : Space(workspace)
  , Corners(static_cast<std::size_t>(cornersOf(mesh.cellType)))
  , Vertices(vertices)
  , Result{ VertexPages(workspace, pageVertices, mesh.doublePositions), {}, {}, 1, 0 }
{
  // Equally distant ranks make a sample that is spread over the mesh.
  this->Result.sampleStride = std::max<std::int64_t>(1, vertices.size() / SampledVertices);
  MeshCounts& counts = this->Result.counts;
  counts.isolatedVertices = mesh.vertices - vertices.size();
  if (mesh.cellType == CellType::Triangle)
  {
    counts.boundaryEdges = counts.nonManifoldEdges = counts.nonManifoldVertices = 0;
  }
}

/** The number of ranks in the links of the page with most of them. */
template <class Real>
std::int64_t GroupPages<Real>::largestPage(const VertexLinks& links, RankRange range) const
{
  const int pageVertices = this->Result.pages.pageVertices();
  std::int64_t largest = 0;
  for (std::int64_t begin = range.begin; begin < range.end; begin += pageVertices)
  {
    largest = std::max(largest, links.size({ begin, std::min(begin + pageVertices, range.end) }));
  }
  return largest;
}

template <class Real>
void GroupPages<Real>::append(const CellGroups& groups, int group)
{
  const RankRange range = groups.range(group);
  // Counted before anything is loaded: the sizes of the links follow from a first pass over the
  // group.
  const std::int64_t allowed = this->Space.available() - Reserve;
  std::int64_t parts = 1;
  {
    VertexLinks links(this->Space, groups, group, this->Corners);
    const std::int64_t largest = this->largestPage(links, range);
    const std::int64_t needed = range.size() * 8 + links.bytes() +
                                VertexStar::bytes(range.size(), links.largest()) +
                                largest * (std::int64_t(sizeof(std::uint32_t)) + EncodedBytes);
    if (needed <= allowed)
    {
      links.load(this->Space, groups, group);
      VertexStar star(this->Space.pool(), range, links.largest());
      Buffer neighbours(
        this->Space.pool(), static_cast<std::size_t>(largest) * sizeof(std::uint32_t));
      const int pageVertices = this->Result.pages.pageVertices();
      for (std::int64_t begin = range.begin; begin < range.end; begin += pageVertices)
      {
        // The neighbours of the vertices of a page follow each other in this buffer, until the page
        // is made.
        std::span<std::uint32_t> rest(
          reinterpret_cast<std::uint32_t*>(neighbours.data()), static_cast<std::size_t>(largest));
        this->appendPage({ begin, std::min(begin + pageVertices, range.end) },
          [&](std::uint32_t vertex) -> std::span<const std::uint32_t>
          {
            const std::span<std::uint32_t> around = rest;
            const std::size_t degree = star.visit(vertex, links.of(vertex), this->Corners, around);
            rest = rest.subspan(degree);
            if (this->Corners == 3)
            {
              addCounts(star, this->Result.counts);
            }
            return around.first(degree);
          });
      }
      return;
    }
    // A group of one page cannot be split.
    if (range.size() <= this->Result.pages.pageVertices())
    {
      throw MemoryError(
        "The mesh needs " + mebibytes(this->Space.pool().limit() - allowed + needed) +
        " of memory to be brought into order, since a vertex has " +
        std::to_string(links.largest() / (this->Corners - 1)) + " cells, but only " +
        mebibytes(this->Space.pool().limit()) + " are allowed: raise the memory limit.");
    }
    // Outside of this block the links are released, so that the parts have all of the memory.
    parts = 2 + needed / std::max<std::int64_t>(allowed, 1);
  }
  this->split(groups, group, parts);
}

template <class Real>
void GroupPages<Real>::split(const CellGroups& groups, int group, std::int64_t parts)
{
  const RankRange range = groups.range(group);
  const std::int64_t collecting = this->Space.available() / 4;
  // Not more parts than there is memory to collect at once; one that is still too large is split
  // again.
  parts = std::min(parts, std::max<std::int64_t>(2, collecting / CollectedBytes));
  CellGroups smaller(this->Space, range,
    roundUp((range.size() + parts - 1) / parts, this->Result.pages.pageVertices()), this->Corners,
    collecting);
  groups.forEach(group, [&smaller](std::span<const std::uint32_t> cell) { smaller.put(cell); });
  smaller.close();
  for (int part = 0; part < smaller.groups(); ++part)
  {
    this->append(smaller, part);
  }
}

/** The number of groups that certainly fit into the memory at once, with the page of another one,
 * as far as there are threads for them. */
template <class Real>
std::size_t GroupPages<Real>::groupsAtOnce(const CellGroups& groups) const
{
  std::int64_t largest = 0, page = 0;
  for (int group = 0; group < groups.groups(); ++group)
  {
    // Upper bounds, from the numbers of cells alone: nothing has been read yet.
    const std::int64_t cells = groups.cells(group);
    largest =
      std::max(largest, GroupStars::maxBytes(groups.range(group).size(), cells, this->Corners));
    page = std::max(page, cells * std::int64_t(this->Corners * this->Corners) * EncodedBytes);
  }
  const int threads = this->Space.workers().threads();
  const std::int64_t fit =
    (this->Space.available() - Reserve - page) / std::max<std::int64_t>(1, largest);
  return threads == 1 ? 1 : static_cast<std::size_t>(std::clamp<std::int64_t>(fit, 1, threads + 1));
}

template <class Real>
void GroupPages<Real>::append(const CellGroups& groups)
{
  struct Item
  {
    int group = 0;
    std::optional<GroupStars> stars;
  };
  const std::size_t atOnce = this->groupsAtOnce(groups);
  OrderedJobs<Item> jobs(
    this->Space.workers(), atOnce,
    [&](Item& item) { item.stars.emplace(this->Space, groups, item.group, this->Corners); },
    [&](Item& item)
    {
      this->append(*item.stars);
      item.stars.reset();
    });
  for (int group = 0; group < groups.groups(); ++group)
  {
    // In turn, with all of the memory for each: larger groups fit, and the largest can be split.
    if (atOnce == 1)
    {
      this->append(groups, group);
      continue;
    }
    jobs.next().group = group;
    jobs.submit();
  }
  jobs.takeAll();
}

template <class Real>
void GroupPages<Real>::append(const GroupStars& stars)
{
  const RankRange range = stars.range();
  const int pageVertices = this->Result.pages.pageVertices();
  for (std::int64_t begin = range.begin; begin < range.end; begin += pageVertices)
  {
    this->appendPage({ begin, std::min(begin + pageVertices, range.end) },
      [&stars](std::uint32_t vertex) { return stars.neighbours(vertex); });
  }
  if (this->Corners == 3)
  {
    MeshCounts& counts = this->Result.counts;
    counts.boundaryEdges += stars.counts().boundaryEdges;
    counts.nonManifoldEdges += stars.counts().nonManifoldEdges;
    counts.nonManifoldVertices += stars.counts().nonManifoldVertices;
  }
}

template <class Real>
template <class Around>
void GroupPages<Real>::appendPage(RankRange page, Around&& around)
{
  this->Page.clear();
  for (std::int64_t rank = page.begin; rank < page.end; ++rank)
  {
    const auto vertex = static_cast<std::uint32_t>(rank);
    const std::span<const std::uint32_t> neighbours = around(vertex);
    for (const std::uint32_t other : neighbours)
    {
      // Unsigned: one comparison finds ranks on either side of the page.
      this->Crossing += other - static_cast<std::uint32_t>(page.begin) >= page.size();
    }
    this->Edges += std::ssize(neighbours);

    RankedVertex<Real> ranked;
    this->Vertices.next(ranked);
    const Real* position = ranked.position;
    this->Page.push_back(
      { { position[0], position[1], position[2] }, ranked.id, NoIndex, neighbours });
    if (rank % this->Result.sampleStride == 0)
    {
      this->Result.samples.insert(this->Result.samples.end(),
        { toFloat(position[0]), toFloat(position[1]), toFloat(position[2]) });
    }
  }
  this->Result.pages.append(this->Page);
}

template <class Real>
PagedMesh GroupPages<Real>::finish()
{
  this->Result.pages.close();
  this->Result.crossing = double(this->Crossing) / double(std::max<std::int64_t>(1, this->Edges));
  return std::move(this->Result);
}

template class GroupPages<float>;
template class GroupPages<double>;

} // namespace smg
