// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/PatchGraph.h"

#include "IO/External/Relabelling.h"

#include <algorithm>

// The graph of patches: nodes are connected parts of runs of consecutive ranks, edges are weighted
// by the numbers of edges of the mesh between them. Since patches are connected, the graph has the
// components of the mesh. It is made in two passes over the adjacency, one to label the patches and
// one for their edges; a run and the graph are in memory.

namespace smg
{

namespace
{

/** The neighbour to which a node is tied most, by the weight of the edge over the mass of the
 * neighbour, among those with may(neighbour); NoIndex if there is none. */
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

/** Groups the nodes for coarsen(), in their order: pairs of free neighbours first; a node whose
 * neighbours are all taken joins the group of the one it is tied to most. */
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
    // All neighbours are in groups already, or there are none.
    const std::uint32_t host = strongest(graph, node, [](std::uint32_t) { return true; });
    groups[node] = host == NoIndex ? count++ : groups[host];
  }
  return count;
}

/** The nodes of each group, group by group, by a counting sort. */
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
          // Entries below `first` are of earlier groups: the table is not cleared between groups.
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

PatchGraph::PatchGraph(VertexPages& pages, Workspace& workspace, PagedArray<std::uint32_t>& patches,
  PagedArray<float>& values)
  : Pages(pages)
  , Stretch(pages, workspace)
  , Patches(patches)
  , Values(values)
{
}

template <class Take>
bool PatchGraph::forEachRun(std::int64_t run, Take&& take)
{
  // A run is a part of a page, or several whole pages.
  const std::int64_t pagesOfRun = std::max<std::int64_t>(1, run / this->Pages.pageVertices());
  for (std::int64_t page = 0; page < this->Pages.pages(); page += pagesOfRun)
  {
    this->Stretch.load(page, std::min(page + pagesOfRun, this->Pages.pages()));
    const std::int64_t end = this->Stretch.end();
    const std::int64_t step = pagesOfRun > 1 ? end - this->Stretch.first() : run;
    for (std::int64_t begin = this->Stretch.first(); begin < end; begin += step)
    {
      if (!take(std::uint32_t(begin), std::uint32_t(std::min(begin + step, end))))
      {
        return false;
      }
    }
  }
  return true;
}

bool PatchGraph::build(std::int64_t run, const PatchLimits& limits)
{
  this->Graph = WeightedGraph();
  this->Closed = 0;
  const bool labelled = this->forEachRun(run,
    [&](std::uint32_t begin, std::uint32_t end)
    {
      this->label(begin, end);
      return this->Graph.masses.size() <= limits.nodes;
    });
  return labelled && this->forEachRun(run,
                       [&](std::uint32_t begin, std::uint32_t end)
                       {
                         this->connect(begin, end);
                         return this->Graph.edges() <= limits.edges;
                       });
}

/** Puts the vertices of a run that are connected to `start` within it into the queue, breadth
 * first, and marks them. Returns whether no edge leaves the run: then they are a whole
 * component. */
bool PatchGraph::search(
  std::uint32_t start, std::uint32_t begin, std::uint32_t end, std::uint8_t mark)
{
  bool closed = true;
  this->Queue.assign(1, start);
  this->Marks[start - begin] = mark;
  for (std::size_t i = 0; i < this->Queue.size(); ++i)
  {
    this->Stretch.neighbours(this->Queue[i],
      [&](std::uint32_t other)
      {
        if (other < begin || other >= end)
        {
          closed = false;
        }
        else if (this->Marks[other - begin] != mark)
        {
          this->Marks[other - begin] = mark;
          this->Queue.push_back(other);
        }
      });
  }
  return closed;
}

void PatchGraph::label(std::uint32_t begin, std::uint32_t end)
{
  this->Marks.assign(end - begin, 0);
  for (std::uint32_t rank = begin; rank < end; ++rank)
  {
    if (this->Marks[rank - begin] != 0)
    {
      continue;
    }
    // A component within the run needs no node of the graph: its vertices get their values here.
    if (this->search(rank, begin, end, 1))
    {
      // The second search starts at the last vertex of the first one, so that its order is narrow.
      this->search(this->Queue.back(), begin, end, 2);
      for (const std::uint32_t vertex : this->Queue)
      {
        this->Patches.at(vertex) = NoIndex;
        this->Values.at(vertex) = static_cast<float>(this->Closed++);
      }
      continue;
    }
    const std::uint32_t patch = this->Graph.nodes();
    for (const std::uint32_t vertex : this->Queue)
    {
      this->Patches.at(vertex) = patch;
    }
    this->Graph.masses.push_back(static_cast<float>(this->Queue.size()));
  }
}

/** Appends the edges of the patches of a run, whose numbers follow the numbers of earlier runs. */
void PatchGraph::connect(std::uint32_t begin, std::uint32_t end)
{
  this->Crossing.clear();
  std::uint32_t next = NoIndex; // after the patches of the run
  for (std::uint32_t rank = begin; rank < end; ++rank)
  {
    const std::uint32_t patch = this->Patches.get(rank);
    if (patch == NoIndex)
    {
      continue;
    }
    next = next == NoIndex ? patch + 1 : std::max(next, patch + 1);
    this->Stretch.neighbours(rank,
      [&](std::uint32_t other)
      {
        // Patches of the same run have no edges between each other: they would be one patch.
        if (other < begin || other >= end)
        {
          this->Crossing.emplace_back(patch, this->Patches.get(other));
        }
      });
  }
  // Equal pairs become neighbours, and their number the weight of the edge.
  std::sort(this->Crossing.begin(), this->Crossing.end());
  for (std::size_t i = 0; i < this->Crossing.size(); ++i)
  {
    const auto [patch, other] = this->Crossing[i];
    if (i > 0 && this->Crossing[i - 1] == this->Crossing[i])
    {
      this->Graph.weights.back() += 1;
      continue;
    }
    // The begins of patches up to this one, also of such without edges.
    while (this->Graph.begin.size() <= patch)
    {
      this->Graph.begin.push_back(static_cast<std::uint32_t>(this->Graph.edges()));
    }
    this->Graph.neighbours.push_back(other);
    this->Graph.weights.push_back(1);
  }
  while (next != NoIndex && this->Graph.begin.size() <= next)
  {
    this->Graph.begin.push_back(static_cast<std::uint32_t>(this->Graph.edges()));
  }
}

} // namespace smg
