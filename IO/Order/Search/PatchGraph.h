// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Order/Pages/VertexAveraging.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** An undirected graph with weights of nodes and edges: each edge is stored with both nodes. */
struct WeightedGraph
{
  std::vector<std::uint32_t> begin{ 0 }; ///< of each node in the edges, and the end of the last
  std::vector<std::uint32_t> neighbours; ///< of each edge
  std::vector<float> weights;            ///< of each edge, positive
  std::vector<float> masses;             ///< of each node, positive

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(this->masses.size()); }
  std::size_t edges() const { return this->neighbours.size(); }

  /** Calls visit(neighbour, weight) for each edge of a node. */
  template <class Visit>
  void forEachEdge(std::uint32_t node, Visit&& visit) const
  {
    for (std::uint32_t k = this->begin[node]; k < this->begin[node + 1]; ++k)
    {
      visit(this->neighbours[k], this->weights[k]);
    }
  }
};

/** Sets `part` to the subgraph of these nodes, which are numbered in their order. `numbers` is
 * scratch memory with one element for each node of the graph. */
void extract(const WeightedGraph& graph, const std::vector<std::uint32_t>& nodes,
  std::vector<std::uint32_t>& numbers, WeightedGraph& part);

/**
 * A coarser graph, of at most half the nodes if all have edges: each node is merged with the
 * neighbour to which it is tied most, by the weight of the edge over the mass of the neighbour; one
 * whose neighbours are all taken joins the group of the one to which it is tied most. Nodes without
 * edges stay as they are.
 * @param groups set to the node of the result for each node
 */
WeightedGraph coarsen(const WeightedGraph& graph, std::vector<std::uint32_t>& groups);

/** The maximum size of the graph of patches. */
struct PatchLimits
{
  std::size_t nodes;
  std::size_t edges; ///< each counted at both nodes
};

/**
 * Cuts paged vertices into *patches*, the connected parts of runs of consecutive ranks, and makes
 * the graph of the patches: masses are numbers of vertices, weights are numbers of edges of the
 * mesh. The graph has the components of the mesh. A component that lies within one run is not a
 * node of the graph: its vertices get their values at once.
 */
class PatchGraph
{
public:
  /** Fills the arrays, by rank: `patches` with the patch, `values` with a position below closed()
   * for each vertex of a component within a run, whose patch is NoIndex. */
  PatchGraph(VertexPages& pages, Workspace& workspace, PagedArray<std::uint32_t>& patches,
    PagedArray<float>& values);

  /** Makes the graph from runs of `run` vertices. Returns false if it exceeds the limits. */
  bool build(std::int64_t run, const PatchLimits& limits);

  const WeightedGraph& graph() const { return this->Graph; }
  /** The number of vertices of components within a run. */
  std::int64_t closed() const { return this->Closed; }

private:
  /** Calls take(begin, end) for each run while it is loaded, until it returns false. */
  template <class Take>
  bool forEachRun(std::int64_t run, Take&& take);
  void label(std::uint32_t begin, std::uint32_t end);
  bool search(std::uint32_t start, std::uint32_t begin, std::uint32_t end, std::uint8_t mark);
  void connect(std::uint32_t begin, std::uint32_t end);

  VertexPages& Pages;
  PageStretch Stretch;
  PagedArray<std::uint32_t>& Patches;
  PagedArray<float>& Values;
  WeightedGraph Graph;
  std::int64_t Closed = 0;
  std::vector<std::uint32_t> Queue;
  std::vector<std::uint8_t> Marks; ///< of the vertices of a run
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Crossing;
};

} // namespace smg
