// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/PageBuilder.h"

#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/EdgeMetric.h"
#include "IO/Order/Pages/GroupPages.h"
#include "IO/Order/Pages/HashStarClustering.h"
#include "IO/Order/Pages/RankedVertices.h"
#include "IO/Order/Pages/VertexStar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// Vertices in pages along a space-filling curve, each page with the adjacency of its vertices: the
// form in which a graph search of the mesh reads little from disk.
//
// Steps, each a sequential pass or an external sort: a metric from a sample of edges; the vertices
// sorted by their keys on a Hilbert curve, which gives them ranks; the cells renumbered by ranks;
// the cells collected in groups of pages; the pages of one group after another. If too many edges
// leave their pages, as where coordinates are arbitrary, ranks come from repeated contraction of
// the graph instead (HashStarClustering.h).
//
// Keys decide the order and ties go to the lower number, so the pages do not depend on threads;
// they do depend on the memory, which chooses the size of pages. The workspace bounds the memory;
// arrange() gives each step its share. The renumbering reads all cells once for each table of ranks
// that fits.

namespace smg
{
namespace
{

/** The vertices of a mesh in the order of their ranks, and the cells by ranks. */
template <class Real>
struct Arrangement
{
  RecordFile<RankedVertex<Real>> vertices;
  CellGroups groups;
  double crossing; ///< share of the edges of sampled cells that leave their page
};

/** Counts the edges of cells that leave their page, for a small sample of the cells. */
class CrossingEstimate
{
public:
  CrossingEstimate(std::int64_t cells, int pageVertices)
    : Stride(1 + cells / 1000000)
    , PageVertices(static_cast<std::uint32_t>(pageVertices))
  {
  }

  void add(std::span<const std::uint32_t> cell)
  {
    // Every Stride-th cell, so about a million at most.
    if (++this->Seen < this->Stride)
    {
      return;
    }
    this->Seen = 0;
    for (std::size_t a = 1; a < cell.size(); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        ++this->Edges;
        this->Crossing += cell[a] / this->PageVertices != cell[b] / this->PageVertices;
      }
    }
  }
  double share() const
  {
    return double(this->Crossing) / double(std::max<std::int64_t>(1, this->Edges));
  }

private:
  std::int64_t Stride, Seen = 0, Edges = 0, Crossing = 0;
  std::uint32_t PageVertices;
};

/** Ranks the vertices by the keys (see rankVertices) and puts the cells into groups. */
template <class Real, class Key>
Arrangement<Real> arrange(const RawMesh& mesh, Workspace& workspace, int pageVertices, Key&& key)
{
  // Shares of the memory: the sort of the vertices and the bits of used vertices are released
  // before the cells are read; the table of ranks and the buckets of the cells are needed together.
  const std::int64_t memory = workspace.available();
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  Relabelling ranks(workspace, mesh.vertices, memory / 2);
  RecordFile<RankedVertex<Real>> vertices = [&]
  {
    // Isolated vertices get no rank.
    UsedVertices used(mesh, workspace, memory / 8);
    return rankVertices<Real>(mesh, workspace, used, memory * 2 / 5, key, ranks);
  }();
  const std::int64_t collecting = memory / 5;
  CellGroups groups(workspace, { 0, vertices.size() },
    groupVertices(vertices.size(), mesh.cells, corners, pageVertices, memory, collecting), corners,
    collecting);
  // Filled in the same pass over the renumbered cells as the groups.
  CrossingEstimate crossing(mesh.cells, pageVertices);
  ranks.apply(mesh.corners, corners,
    [&](std::span<const std::uint32_t> cell)
    {
      groups.put(cell);
      crossing.add(cell);
    });
  if (mesh.links.size() > 0)
  {
    // As cells of which one corner is repeated, which are neighbours and nothing else.
    std::array<std::uint32_t, 4> cell{};
    ranks.apply(mesh.links, 2,
      [&](std::span<const std::uint32_t> link)
      {
        if (std::ranges::find(link, NoIndex) == link.end())
        {
          cell = { link[0], link[1], link[1], link[1] };
          groups.put(std::span<const std::uint32_t>(cell).first(corners));
        }
      });
  }
  groups.close();
  return { std::move(vertices), std::move(groups), crossing.share() };
}

/** The arrangement by coordinates, or by the numbers of the vertices if these represent
 * neighbourhood better, as in files whose numbers follow the mesh. */
template <class Real>
Arrangement<Real> arrangeByPlace(const RawMesh& mesh, Workspace& workspace, int pageVertices)
{
  const CellSample sample = sampleCells(mesh);
  const EdgeMetric metric(sample);
  if (numbersAreMoreLocal(sample, metric, mesh.vertices, 4.0 * pageVertices))
  {
    return arrange<Real>(mesh, workspace, pageVertices,
      [](std::uint32_t id, const Real*) { return std::uint64_t(id); });
  }
  return arrange<Real>(mesh, workspace, pageVertices,
    [&metric](std::uint32_t, const Real* position) { return metric.key(position); });
}

/** The arrangement by clusters of the mesh's graph. */
template <class Real>
Arrangement<Real> arrangeByGraph(const RawMesh& mesh, Workspace& workspace, int pageVertices)
{
  const RecordFile<std::uint32_t> numbers = clusterNumbers(mesh, workspace);
  RecordFile<std::uint32_t>::Reader next(numbers);
  std::int64_t read = 0;
  return arrange<Real>(mesh, workspace, pageVertices,
    [&](std::uint32_t id, const Real*)
    {
      // Keys are asked for in ascending order of the vertices, without the isolated ones.
      std::uint32_t number = NoIndex;
      for (; read <= std::int64_t(id); ++read)
      {
        next.next(number);
      }
      return std::uint64_t(number);
    });
}

template <class Real>
Arrangement<Real> arrange(
  const RawMesh& mesh, Workspace& workspace, int pageVertices, bool topological)
{
  if (topological)
  {
    return arrangeByGraph<Real>(mesh, workspace, pageVertices);
  }
  Arrangement<Real> byPlace = arrangeByPlace<Real>(mesh, workspace, pageVertices);
  if (byPlace.crossing <= maxCrossing(mesh.cellType, pageVertices))
  {
    return byPlace;
  }
  // The better of both: around a vertex that is connected to nearly all others no order is good,
  // and the curve may still be the better one.
  Arrangement<Real> byGraph = arrangeByGraph<Real>(mesh, workspace, pageVertices);
  return byGraph.crossing < byPlace.crossing ? std::move(byGraph) : std::move(byPlace);
}

/** Chooses the size of the pages, arranges the vertices and makes the pages. */
template <class Real>
PagedMesh build(const RawMesh& mesh, Workspace& workspace, const PageOptions& options)
{
  const int pageVertices = options.pageVertices > 0
                             ? options.pageVertices
                             : choosePageVertices(mesh.cellType, mesh.doublePositions,
                                 mesh.vertices, workspace.available());
  const Arrangement<Real> arranged =
    arrange<Real>(mesh, workspace, pageVertices, options.topological);
  GroupPages<Real> pages(mesh, workspace, arranged.vertices, pageVertices);
  pages.append(arranged.groups);
  return pages.finish();
}

constexpr int MinVertices = 64;
constexpr std::int64_t DirectoryBytes = 32; ///< of a page, always in memory

/**
 * Measured bytes of the pages at the front of a search, with a reserve. The front has about 5
 * sqrt(n) vertices on surfaces and 2 n^(2/3) in solids; the pages of B vertices that a front of q
 * vertices meets have about 1.35 q sqrt(B), or 2.1 q B^(1/3), vertices in all, each with 30 or 42
 * bytes.
 */
double frontierBytes(
  bool triangles, bool doublePositions, std::int64_t vertices, double pageVertices)
{
  constexpr double reserve = 1.5;
  const double count = double(vertices), positions = doublePositions ? 12 : 0;
  if (triangles)
  {
    const double queue = 5 * std::sqrt(count);
    return reserve * 1.35 * queue * std::sqrt(pageVertices) * (30 + positions);
  }
  const double queue = 2 * std::cbrt(count * count);
  return reserve * 2.1 * queue * std::cbrt(pageVertices) * (42 + positions);
}

} // namespace

PagedMesh buildPages(const RawMesh& mesh, Workspace& workspace, const PageOptions& options)
{
  return mesh.doublePositions ? build<double>(mesh, workspace, options)
                              : build<float>(mesh, workspace, options);
}

int choosePageVertices(
  CellType cellType, bool doublePositions, std::int64_t vertices, std::int64_t memory)
{
  const bool triangles = cellType == CellType::Triangle;
  const double cache = double(memory) / 2;
  // Larger pages are fewer and cost less to list; smaller ones contain fewer vertices beside the
  // front of a search, so that all pages at the front fit into the cache. Below that each page
  // would be loaded many times.
  int pageVertices = triangles ? 512 : 256;
  while (pageVertices > MinVertices &&
         frontierBytes(triangles, doublePositions, vertices, pageVertices) > cache)
  {
    pageVertices /= 2;
  }
  // Very large meshes: the list of pages itself must stay small.
  while (vertices / pageVertices * DirectoryBytes > memory / 8 && pageVertices < (1 << 20))
  {
    pageVertices *= 2;
  }
  return pageVertices;
}

double maxCrossing(CellType cellType, int pageVertices)
{
  // Edges leave a page through its border, whose share falls like one over the square root, or
  // cubic root, of the vertices of a page.
  const double border =
    cellType == CellType::Triangle ? 8 / std::sqrt(pageVertices) : 3.2 / std::cbrt(pageVertices);
  return std::min(border, 0.8);
}

} // namespace smg
