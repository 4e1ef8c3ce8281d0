// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/BreadthFirstOrder.h"

#include "IO/External/Relabelling.h"
#include "IO/Order/Search/PagedSearch.h"
#include "IO/Order/Search/SearchPlan.h"

#include <algorithm>

// The order `bfs`: component by component, each by a breadth-first search from sources that a plan
// has chosen (SearchPlan.h) if it is large, and otherwise from its end. One component after
// another, so the window of the order is the largest of theirs and not their sum.
//
// Each component costs a probe, a plan of up to two dozen further probes if it is large, and the
// placing search; pages that several components share are loaded for each of them. The result
// depends on the mesh and, by the size of pages, on the memory, but not on the number of threads.

namespace smg
{

namespace
{

/** Components up to this size are searched from the end of their first search; a second sweep would
 * hardly change them. */
constexpr std::int64_t Tiny = 64;
/** The most vertices that all searches from landmarks together may visit, and the least number of
 * landmarks: large meshes profit less from more landmarks, and pay more for each. */
constexpr std::int64_t Visits = 16'000'000;
constexpr int MinLandmarks = 4;

int landmarksFor(std::int64_t vertices, const BreadthFirstOptions& options)
{
  const std::int64_t affordable = Visits / std::max<std::int64_t>(1, vertices);
  return std::min(options.landmarks, std::max(MinLandmarks, static_cast<int>(affordable)));
}

/** A search and its cache, which share the memory that is available. */
class Searching
{
public:
  /** kept(helpers): bytes that are left for other purposes, among them a plan with this number of
   * helpers. */
  template <class Kept>
  Searching(VertexPages& pages, Workspace& workspace, Kept&& kept)
    : Helpers(helpersFor(pages, workspace, kept))
    , Cache(pages, workspace, cacheBytes(pages, workspace, kept(this->Helpers), this->Helpers))
    , Search(pages, this->Cache, workspace, queueBytes(workspace))
  {
  }

  /** Searches besides this one that are possible at the same time. */
  const int Helpers;
  PageCache Cache;
  PagedSearch Search;

private:
  static std::size_t queueBytes(Workspace& workspace)
  {
    // The queue has as many vertices as the window of the order: a small share of the memory
    // suffices, and what exceeds it goes to disk.
    return std::clamp<std::size_t>(
      std::size_t(workspace.pool().limit()) / 32, std::size_t(64) << 10, std::size_t(4) << 20);
  }
  static std::int64_t cacheBytes(
    const VertexPages& pages, Workspace& workspace, std::int64_t kept, int helpers)
  {
    const std::int64_t rest = workspace.available() - kept -
                              (1 + helpers) * PagedSearch::memoryFor(pages, queueBytes(workspace)) -
                              pages.pages() * std::int64_t(sizeof(std::uint32_t)) - 4096;
    return std::min(rest, PageCache::maxBytes(pages));
  }
  /** Helpers search at the same time only if the cache has all pages, so as many as leave room for
   * these. */
  template <class Kept>
  static int helpersFor(const VertexPages& pages, Workspace& workspace, Kept&& kept)
  {
    int helpers = std::min(workspace.workers().threads() - 1, MaxSearchHelpers);
    while (helpers > 0 &&
           cacheBytes(pages, workspace, kept(helpers), helpers) < pages.allAdjacencyBytes())
    {
      --helpers;
    }
    return helpers;
  }
};

class ComponentOrder
{
public:
  ComponentOrder(PagedMesh& mesh, Workspace& workspace, const BreadthFirstOptions& options)
    : Mesh(mesh)
    , Space(workspace)
    , Landmarks(landmarksFor(mesh.pages.vertices(), options))
    , Searches(mesh.pages, workspace,
        [&](int helpers)
        {
          const int threads = helpers > 0 ? workspace.workers().threads() : 1;
          return std::int64_t(BucketFile::ChunkBytes) +
                 (this->Landmarks > 0 ? searchPlanMemory(mesh, this->Landmarks, threads, helpers)
                                      : 0);
        })
    , MinPlanned(std::max(options.minPlanned, mesh.pages.vertices() / 200))
  {
  }

  /** Orders the component of a vertex without a position. */
  void order(std::uint32_t rank, OrderedVertices& order)
  {
    // Loads are counted apart for the placing search, which should load each page about once.
    const std::vector<SearchSource> sources = this->sources(rank);
    const std::int64_t before = this->Searches.Cache.loads();
    this->Searches.Search.place(sources, order);
    this->Traffic.loads += this->Searches.Cache.loads() - before;
  }

  /** The first vertex of a page, from `vertex` on, without a position. */
  std::uint32_t nextUnplaced(std::uint32_t page, std::uint32_t vertex)
  {
    const std::span<const std::uint32_t> places = this->Searches.Cache.whole(page).places();
    return static_cast<std::uint32_t>(
      std::find(places.begin() + vertex, places.end(), NoIndex) - places.begin());
  }

  PageTraffic traffic() const
  {
    PageTraffic traffic = this->Traffic;
    traffic.pages = this->Mesh.pages.pages();
    traffic.probeLoads = this->Searches.Cache.loads() - traffic.loads;
    traffic.probes = this->Searches.Search.probes();
    return traffic;
  }

private:
  std::vector<SearchSource> sources(std::uint32_t rank)
  {
    PagedSearch& search = this->Searches.Search;
    // The size of the component is known only after a search.
    const std::vector<SearchSource> first = { { 0, rank } };
    SearchResult result = search.probe(first);
    if (this->Landmarks > 0 && result.vertices >= this->MinPlanned)
    {
      return planSearch(
        search, this->Mesh, this->Space, this->Landmarks, result.last, this->Searches.Helpers);
    }
    if (result.vertices > Tiny)
    {
      // A double sweep: the last vertex of a search from the last vertex of another one is about as
      // far out as possible.
      const std::vector<SearchSource> second = { { 0, result.last } };
      result = search.probe(second);
    }
    return { { 0, result.last } };
  }

  PagedMesh& Mesh;
  Workspace& Space;
  const int Landmarks;
  Searching Searches;
  std::int64_t MinPlanned;
  PageTraffic Traffic;
};

} // namespace

OrderedVertices breadthFirstOrder(
  PagedMesh& mesh, Workspace& workspace, const BreadthFirstOptions& options, PageTraffic* traffic)
{
  OrderedVertices order(workspace);
  order.doublePositions = mesh.pages.doublePositions();
  mesh.counts.components = 0;
  if (mesh.pages.vertices() > 0)
  {
    ComponentOrder components(mesh, workspace, options);
    for (std::uint32_t page = 0; page < mesh.pages.pages(); ++page)
    {
      // Components are taken in the order of their first vertices on the curve.
      for (std::uint32_t vertex = 0; mesh.pages.unplaced(page) > 0; ++vertex)
      {
        vertex = components.nextUnplaced(page, vertex);
        components.order(mesh.pages.firstRank(page) + vertex, order);
        ++mesh.counts.components;
      }
    }
    if (traffic)
    {
      *traffic = components.traffic();
    }
  }
  order.records.close();
  return order;
}

std::int64_t countComponents(PagedMesh& mesh, Workspace& workspace)
{
  return mesh.pages.vertices() > 0
           ? Searching(mesh.pages, workspace, [](int) { return std::int64_t(0); })
               .Search.components()
           : 0;
}

} // namespace smg
