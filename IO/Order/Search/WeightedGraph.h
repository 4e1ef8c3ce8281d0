// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
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

/** Sets `part` to the subgraph of these nodes, numbered in their order. `numbers` is scratch memory
 * with one number for each node of the graph. */
void extract(const WeightedGraph& graph, const std::vector<std::uint32_t>& nodes,
  std::vector<std::uint32_t>& numbers, WeightedGraph& part);

/**
 * A graph of at most half the nodes: each is merged with the neighbour that it is tied to most, by
 * the edge's weight over the neighbour's mass; one whose neighbours are all taken joins the
 * nearest group. Nodes without edges stay as they are.
 * @param groups set to the node of the result of each node
 */
WeightedGraph coarsen(const WeightedGraph& graph, std::vector<std::uint32_t>& groups);

} // namespace smg
