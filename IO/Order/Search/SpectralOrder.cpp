// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SpectralOrder.h"

#include "IO/Order/Pages/VertexAveraging.h"
#include "IO/Order/Search/AxisOrder.h"
#include "IO/Order/Search/FiedlerVector.h"
#include "IO/Order/Search/PatchGraph.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <numeric>
#include <optional>

// The order `spectral`: along the Fiedler vector of the graph of the mesh, out of core.
//
// The vertices are cut into patches, connected parts of runs of the curve, and the Fiedler vector
// of each component of the graph of patches is computed in memory. Patches are sorted by it; each
// vertex gets the middle of its patch as a value, and the values are smoothed by averaging over
// neighbours, first in groups and then vertex by vertex. Sorting the vertices by value gives the
// order.
//
// Runs are as short as the memory for the graph permits, PatchBytes for each patch. Where no run
// fits, because the pages do not represent neighbourhood, the caller takes another order. Cost: the
// eigenvector of a graph of at most MaxPatches nodes, and some dozen passes over the adjacency.

namespace smg
{

namespace
{

/** Vertices of a run, if the memory permits: shorter ones hardly improve the order. */
constexpr std::int64_t MinRun = 32;
/** Patches with up to this number of vertices are smoothed well by sweeps over single vertices. */
constexpr std::int64_t MaxSmoothed = 64;
constexpr int VertexSweeps = 4;
/** Bytes for a patch of the graph: its edges, its share of the graph of a component and of the
 * coarser ones, and the vectors. */
constexpr std::int64_t PatchBytes = 600;
constexpr std::size_t EdgesPerPatch = 16;
/** The vector of more patches is slow to compute and does not improve the order. */
constexpr std::size_t MaxPatches = std::size_t(1) << 19;
constexpr std::size_t PolledComponents = 256;

/** The connected components of a graph: the nodes of each, component by component. */
struct GraphComponents
{
  explicit GraphComponents(const WeightedGraph& graph)
  {
    std::vector<std::uint8_t> seen(graph.nodes(), 0);
    this->nodes.reserve(graph.nodes());
    for (std::uint32_t start = 0; start < graph.nodes(); ++start)
    {
      if (seen[start])
      {
        continue;
      }
      seen[start] = 1;
      std::size_t next = this->nodes.size();
      for (this->nodes.push_back(start); next < this->nodes.size(); ++next)
      {
        graph.forEachEdge(this->nodes[next],
          [&](std::uint32_t other, float)
          {
            if (!seen[other])
            {
              seen[other] = 1;
              this->nodes.push_back(other);
            }
          });
      }
      // Ascending, so that subgraphs keep the order of the nodes along the curve.
      std::sort(this->nodes.begin() + std::ptrdiff_t(this->begin.back()), this->nodes.end());
      this->begin.push_back(this->nodes.size());
    }
  }

  std::vector<std::size_t> begin{ 0 };
  std::vector<std::uint32_t> nodes;
};

/** For each node of the graph the middle of the positions of its vertices, if nodes are sorted by
 * the Fiedler vector, component by component, and positions begin at `first`. */
std::vector<float> expectedPlaces(const WeightedGraph& graph, double first, Workspace& workspace)
{
  std::vector<float> places(graph.nodes());
  const GraphComponents components(graph);
  std::vector<std::uint32_t> numbers(graph.nodes());
  WeightedGraph part;
  for (std::size_t c = 0; c + 1 < components.begin.size(); ++c)
  {
    if (c % PolledComponents == 0)
    {
      workspace.poll();
    }
    std::vector<std::uint32_t> nodes(components.nodes.begin() + std::ptrdiff_t(components.begin[c]),
      components.nodes.begin() + std::ptrdiff_t(components.begin[c + 1]));
    extract(graph, nodes, numbers, part);
    const std::vector<double> vector = fiedlerVector(part, [&workspace] { workspace.poll(); });
    std::vector<std::uint32_t> sorted(part.nodes());
    std::iota(sorted.begin(), sorted.end(), 0u);
    // Ties go to the node that comes first, so the order is unique.
    std::ranges::sort(sorted, [&](std::uint32_t a, std::uint32_t b)
      { return vector[a] != vector[b] ? vector[a] < vector[b] : a < b; });
    for (const std::uint32_t i : sorted)
    {
      places[nodes[i]] = static_cast<float>(first + part.masses[i] / 2);
      first += part.masses[i];
    }
  }
  return places;
}

/** Computes a value for each vertex, by which the vertices are sorted. */
class SpectralValues
{
public:
  SpectralValues(VertexPages& pages, Workspace& workspace)
    : Pages(pages)
    , Space(workspace)
    , ArrayBytes(std::clamp<std::int64_t>(
        workspace.available() / 8, std::int64_t(256) << 10, std::int64_t(64) << 20))
    , Reserved(workspace.pool(), this->ArrayBytes)
    , Values(workspace.folder(), this->ArrayBytes)
  {
  }

  /** Returns false if the pages do not represent the neighbourhoods of the mesh, so that there are
   * too many patches. */
  bool compute();

  float operator[](std::uint32_t rank) { return this->Values.get(rank); }

private:
  /** The longest run whose adjacency fits into a share of the memory. */
  std::int64_t longestRun() const
  {
    // In addition to the adjacency, the labelling of a run needs 5 bytes per vertex, and 8 per
    // crossing edge.
    const std::int64_t bytesOfVertex =
      this->Pages.allAdjacencyBytes() * 5 / 4 / std::max<std::int64_t>(1, this->Pages.vertices()) +
      16;
    return std::max<std::int64_t>(
      this->Pages.pageVertices(), this->Space.available() / 4 / bytesOfVertex);
  }

  VertexPages& Pages;
  Workspace& Space;
  std::int64_t ArrayBytes;
  Reservation Reserved;
  PagedArray<float> Values;
};

bool SpectralValues::compute()
{
  const Reservation reservedPatches(this->Space.pool(), this->ArrayBytes);
  PagedArray<std::uint32_t> patches(this->Space.folder(), this->ArrayBytes);
  const std::int64_t graphBytes =
    std::min(this->Space.available() / 2, std::int64_t(MaxPatches) * PatchBytes);
  std::optional<Reservation> reservedGraph(std::in_place, this->Space.pool(), graphBytes);
  const auto maxNodes = static_cast<std::size_t>(graphBytes / PatchBytes);
  const PatchLimits limits{ maxNodes, maxNodes * EdgesPerPatch };

  // The shortest run that may give few enough patches; a run usually has more than one.
  std::int64_t run = MinRun;
  while (this->Pages.vertices() / run > std::int64_t(maxNodes) / 2)
  {
    run *= 2;
  }
  const std::int64_t longest = this->longestRun();
  std::optional<PatchGraph> graph(std::in_place, this->Pages, this->Space, patches, this->Values);
  // If the graph exceeds its limits, longer runs may do.
  for (; run <= longest && !graph->build(run, limits); run *= 4)
  {
  }
  if (run > longest)
  {
    return false;
  }
  const auto closed = static_cast<double>(graph->closed());
  {
    const std::vector<float> places = expectedPlaces(graph->graph(), closed, this->Space);
    // Values and adjacency are needed from here on, not the graph: its memory is free for them.
    graph.reset();
    for (std::int64_t rank = 0; rank < this->Pages.vertices(); ++rank)
    {
      if (const std::uint32_t patch = patches.get(rank); patch != NoIndex)
      {
        this->Values.at(rank) = places[patch];
      }
    }
  }
  reservedGraph.reset();

  VertexAveraging averaging(this->Pages, this->Space, this->Values, static_cast<float>(closed));
  // All vertices of a patch have one value at first. Long runs are smoothed in ever smaller groups,
  // down to single vertices.
  for (; run > MaxSmoothed; run /= 8)
  {
    averaging.sweepRuns(run / 8, patches);
  }
  for (int sweep = 0; sweep < VertexSweeps; ++sweep)
  {
    averaging.sweepVertices();
  }
  return true;
}

} // namespace

OrderedVertices spectralOrder(
  PagedMesh& mesh, Workspace& workspace, std::vector<std::string>* notes)
{
  VertexPages& pages = mesh.pages;
  SpectralValues values(pages, workspace);
  if (!values.compute())
  {
    if (notes)
    {
      notes->push_back(
        "The order is that of \"axis\", since the graph for \"spectral\" has no room "
        "in the memory limit.");
    }
    return axisOrder(pages, workspace);
  }
  const auto value = [&values](const PageView& page, std::uint32_t i)
  { return double(values[page.firstRank() + i]); };
  return pages.doublePositions() ? scalarOrder<double>(pages, workspace, value)
                                 : scalarOrder<float>(pages, workspace, value);
}

} // namespace smg
