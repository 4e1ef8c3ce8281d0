// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/WeightedGraph.h"

#include "IO/External/Relabelling.h"

#include <algorithm>

namespace smg
{

namespace
{

/**
 * The most strongly connected neighbour of a node among those accepted by `may`; NoIndex if none.
 */
template <class May>
std::uint32_t strongest(const WeightedGraph& graph, std::uint32_t node, May&& may)
{
  std::uint32_t best = NoIndex;
  float bestTie = 0;
  graph.forEachEdge(node,
    [&](std::uint32_t other, float weight)
    {
      const float tie = weight / graph.masses[other];
      if (tie > bestTie && may(other))
      {
        best = other;
        bestTie = tie;
      }
    });
  return best;
}

std::uint32_t makeGroups(const WeightedGraph& graph, std::vector<std::uint32_t>& groups)
{
  groups.assign(graph.nodes(), NoIndex);
  std::uint32_t count = 0;
  for (std::uint32_t node = 0; node < graph.nodes(); ++node)
  {
    if (groups[node] != NoIndex)
    {
      continue;
    }
    const std::uint32_t partner =
      strongest(graph, node, [&](std::uint32_t other) { return groups[other] == NoIndex; });
    if (partner != NoIndex)
    {
      groups[node] = groups[partner] = count++;
      continue;
    }
    const std::uint32_t host = strongest(graph, node, [](std::uint32_t) { return true; });
    groups[node] = host == NoIndex ? count++ : groups[host];
  }
  return count;
}

/** The nodes of each group, group by group: counting sort. */
struct Members
{
  Members(const std::vector<std::uint32_t>& groups, std::uint32_t count)
    : begin(count + 1, 0)
    , nodes(groups.size())
  {
    for (const std::uint32_t group : groups)
    {
      ++this->begin[group + 1];
    }
    for (std::uint32_t group = 0; group < count; ++group)
    {
      this->begin[group + 1] += this->begin[group];
    }
    std::vector<std::uint32_t> next(this->begin.begin(), this->begin.end() - 1);
    for (std::uint32_t node = 0; node < groups.size(); ++node)
    {
      this->nodes[next[groups[node]]++] = node;
    }
  }

  std::vector<std::uint32_t> begin, nodes;
};

} // namespace

void extract(const WeightedGraph& graph, const std::vector<std::uint32_t>& nodes,
  std::vector<std::uint32_t>& numbers, WeightedGraph& part)
{
  part = WeightedGraph();
  std::size_t edges = 0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    numbers[nodes[i]] = i;
    edges += graph.begin[nodes[i] + 1] - graph.begin[nodes[i]];
  }
  part.begin.reserve(nodes.size() + 1);
  part.masses.reserve(nodes.size());
  part.neighbours.reserve(edges);
  part.weights.reserve(edges);
  for (const std::uint32_t node : nodes)
  {
    graph.forEachEdge(node,
      [&](std::uint32_t other, float weight)
      {
        part.neighbours.push_back(numbers[other]);
        part.weights.push_back(weight);
      });
    part.begin.push_back(static_cast<std::uint32_t>(part.edges()));
    part.masses.push_back(graph.masses[node]);
  }
}

WeightedGraph coarsen(const WeightedGraph& graph, std::vector<std::uint32_t>& groups)
{
  const std::uint32_t count = makeGroups(graph, groups);
  const Members members(groups, count);
  WeightedGraph coarse;
  coarse.masses.assign(count, 0);
  std::vector<std::uint32_t> edgeTo(count, NoIndex); // the group's edge to each other one
  for (std::uint32_t group = 0; group < count; ++group)
  {
    const std::uint32_t first = coarse.begin[group];
    for (std::uint32_t k = members.begin[group]; k < members.begin[group + 1]; ++k)
    {
      coarse.masses[group] += graph.masses[members.nodes[k]];
      graph.forEachEdge(members.nodes[k],
        [&](std::uint32_t other, float weight)
        {
          const std::uint32_t to = groups[other];
          std::uint32_t& edge = edgeTo[to];
          if (to == group)
          {
            return;
          }
          if (edge == NoIndex || edge < first)
          {
            edge = static_cast<std::uint32_t>(coarse.edges());
            coarse.neighbours.push_back(to);
            coarse.weights.push_back(0);
          }
          coarse.weights[edge] += weight;
        });
    }
    coarse.begin.push_back(static_cast<std::uint32_t>(coarse.edges()));
  }
  return coarse;
}

} // namespace smg
