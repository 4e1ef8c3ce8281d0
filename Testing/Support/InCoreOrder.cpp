// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/InCoreOrder.h"

#include "IO/External/Relabelling.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace smg::testing
{
namespace
{

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/** Searches from `start`; the reached vertices are appended to the queue from `begin` on. */
void search(const Neighbours& neighbours, std::uint32_t start, std::size_t begin,
  std::uint32_t epoch, std::vector<std::uint32_t>& mark, std::vector<std::uint32_t>& queue)
{
  queue.resize(begin);
  queue.push_back(start);
  mark[start] = epoch;
  for (std::size_t head = begin; head < queue.size(); ++head)
  {
    for (const std::uint32_t other : neighbours[queue[head]])
    {
      if (mark[other] != epoch)
      {
        mark[other] = epoch;
        queue.push_back(other);
      }
    }
  }
}

} // namespace

Neighbours neighboursOf(const IndexedTestMesh& mesh)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::vector<Pair> edges;
  for (std::size_t cell = 0; cell < mesh.corners.size(); cell += corners)
  {
    for (std::size_t i = 0; i < corners; ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        edges.emplace_back(mesh.corners[cell + i], mesh.corners[cell + j]);
      }
    }
  }
  return neighboursOf(static_cast<std::size_t>(mesh.vertices()), edges);
}

Neighbours neighboursOf(std::size_t vertices, std::span<const Pair> edges)
{
  Neighbours result;
  std::vector<std::size_t> ends(vertices + 1);
  for (const auto& [a, b] : edges)
  {
    ++ends[a + 1];
    ++ends[b + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::uint32_t> all(ends.back());
  std::vector<std::size_t> at(ends.begin(), ends.end() - 1);
  for (const auto& [a, b] : edges)
  {
    all[at[a]++] = b;
    all[at[b]++] = a;
  }
  result.begins.push_back(0);
  for (std::size_t vertex = 0; vertex < vertices; ++vertex)
  {
    const auto begin = all.begin() + std::ptrdiff_t(ends[vertex]);
    const auto end = all.begin() + std::ptrdiff_t(ends[vertex + 1]);
    std::sort(begin, end);
    std::copy_if(begin, std::unique(begin, end), std::back_inserter(result.all),
      [vertex](std::uint32_t other) { return other != vertex; });
    result.begins.push_back(result.all.size());
  }
  return result;
}

std::vector<std::uint32_t> inCoreBreadthFirst(const Neighbours& neighbours)
{
  std::vector<std::uint32_t> mark(neighbours.vertices(), 0), queue;
  std::uint32_t epoch = 0;
  std::size_t done = 0;
  for (std::uint32_t vertex = 0; vertex < neighbours.vertices(); ++vertex)
  {
    if (mark[vertex] == 0)
    {
      search(neighbours, vertex, done, ++epoch, mark, queue);
      search(neighbours, queue.back(), done, ++epoch, mark, queue);
      search(neighbours, queue.back(), done, ++epoch, mark, queue);
      done = queue.size();
    }
  }
  return queue;
}

std::vector<std::uint32_t> inCoreLevels(const Neighbours& neighbours, std::span<const Pair> sources)
{
  std::vector<std::uint32_t> levels(neighbours.vertices(), NoIndex);
  for (bool isChanged = true; isChanged;)
  {
    isChanged = false;
    const auto lower = [&](std::uint32_t vertex, std::uint32_t level)
    {
      isChanged = isChanged || level < levels[vertex];
      levels[vertex] = std::min(levels[vertex], level);
    };
    for (const auto& [vertex, level] : sources)
    {
      lower(vertex, level);
    }
    for (std::uint32_t vertex = 0; vertex < neighbours.vertices(); ++vertex)
    {
      for (const std::uint32_t other : neighbours[vertex])
      {
        if (levels[other] != NoIndex)
        {
          lower(vertex, levels[other] + 1);
        }
      }
    }
  }
  return levels;
}

std::int64_t inCoreComponents(const Neighbours& neighbours)
{
  std::vector<std::uint32_t> mark(neighbours.vertices(), 0), queue;
  std::int64_t count = 0;
  for (std::uint32_t vertex = 0; vertex < neighbours.vertices(); ++vertex)
  {
    if (mark[vertex] == 0)
    {
      search(neighbours, vertex, 0, 1, mark, queue);
      ++count;
    }
  }
  return count;
}

OrderSize orderSize(const Neighbours& neighbours, std::span<const std::uint32_t> order)
{
  std::vector<std::int64_t> places(neighbours.vertices());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    places[order[i]] = static_cast<std::int64_t>(i);
  }
  OrderSize size;
  std::int64_t reach = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (const std::uint32_t other : neighbours[order[i]])
    {
      reach = std::max(reach, places[other]);
      size.span = std::max(size.span, places[other] - std::int64_t(i));
    }
    size.meanWindow += double(std::max<std::int64_t>(0, reach - std::int64_t(i)));
  }
  size.meanWindow /= std::max<double>(1, double(order.size()));
  return size;
}

} // namespace smg::testing
