// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/PageBuilder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace smg::testing
{

/** A mesh in memory. */
struct CoreMesh
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::uint32_t> corners;
  std::size_t cornersOfCell = 3;

  std::size_t cells() const { return this->corners.size() / this->cornersOfCell; }
};

/** The neighbours of each vertex, ascending. */
inline std::vector<std::vector<std::uint32_t>> neighboursOf(const CoreMesh& mesh)
{
  std::vector<std::vector<std::uint32_t>> neighbours(mesh.points.size());
  for (std::size_t c = 0; c < mesh.corners.size(); c += mesh.cornersOfCell)
  {
    for (std::size_t i = 0; i < mesh.cornersOfCell; ++i)
    {
      for (std::size_t j = 0; j < mesh.cornersOfCell; ++j)
      {
        if (mesh.corners[c + i] != mesh.corners[c + j])
        {
          neighbours[mesh.corners[c + i]].push_back(mesh.corners[c + j]);
        }
      }
    }
  }
  for (auto& list : neighbours)
  {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

/** The vertices with cells along a Morton curve. */
inline std::vector<std::uint32_t> mortonOrder(
  const CoreMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbours)
{
  std::array<double, 3> least = mesh.points.front();
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double most = least[axis];
    for (const auto& point : mesh.points)
    {
      least[axis] = std::min(least[axis], point[axis]);
      most = std::max(most, point[axis]);
    }
    extent = std::max(extent, most - least[axis]);
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
  {
    if (neighbours[v].empty())
    {
      continue;
    }
    std::uint64_t key = 0;
    for (int bit = 19; bit >= 0; --bit)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto cell = static_cast<std::uint64_t>(
          (mesh.points[v][axis] - least[axis]) / (extent > 0 ? extent : 1) * 1048575);
        key = key << 1 | (cell >> bit & 1);
      }
    }
    keys.emplace_back(key, v);
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  for (const auto& [key, v] : keys)
  {
    order.push_back(v);
  }
  return order;
}

/** Puts the vertices that cells use into pages in this order. */
inline PagedMesh makePages(Workspace& workspace, const CoreMesh& mesh,
  const std::vector<std::vector<std::uint32_t>>& neighbours,
  const std::vector<std::uint32_t>& order, int pageVertices)
{
  std::vector<std::uint32_t> rank(mesh.points.size());
  for (std::uint32_t r = 0; r < order.size(); ++r)
  {
    rank[order[r]] = r;
  }
  PagedMesh result{ VertexPages(workspace, pageVertices, true), {}, {}, 1, 0 };
  std::vector<std::vector<std::uint32_t>> ranks(static_cast<std::size_t>(pageVertices));
  for (std::size_t begin = 0; begin < order.size(); begin += ranks.size())
  {
    std::vector<VertexPages::Vertex> page;
    for (std::size_t r = begin; r < std::min(begin + ranks.size(), order.size()); ++r)
    {
      std::vector<std::uint32_t>& list = ranks[r - begin];
      list.clear();
      for (const std::uint32_t other : neighbours[order[r]])
      {
        list.push_back(rank[other]);
      }
      const auto& p = mesh.points[order[r]];
      page.push_back({ { p[0], p[1], p[2] }, order[r], NoIndex, list });
    }
    result.pages.append(page);
  }
  result.pages.close();
  return result;
}

inline PagedMesh mortonPages(Workspace& workspace, const CoreMesh& mesh, int pageVertices)
{
  const auto neighbours = neighboursOf(mesh);
  return makePages(workspace, mesh, neighbours, mortonOrder(mesh, neighbours), pageVertices);
}

/** The vertices' numbers in an order. */
inline std::vector<std::uint32_t> numbersOf(const OrderedVertices& order)
{
  std::vector<std::uint32_t> numbers;
  BucketFile::Reader reader(order.records);
  for (OrderedVertex<double> vertex; reader.get(vertex);)
  {
    numbers.push_back(vertex.id);
  }
  return numbers;
}

/** Most vertices alive at once in the stream of an order: each cell comes with its last vertex,
 * each vertex with its first cell. */
inline std::int64_t widthOf(const CoreMesh& mesh, const std::vector<std::uint32_t>& order)
{
  std::vector<std::uint32_t> place(mesh.points.size());
  for (std::uint32_t p = 0; p < order.size(); ++p)
  {
    place[order[p]] = p;
  }
  const std::size_t corners = mesh.cornersOfCell;
  std::vector<std::array<std::uint32_t, 4>> sorted(mesh.cells());
  for (std::size_t c = 0; c < sorted.size(); ++c)
  {
    sorted[c] = {};
    for (std::size_t k = 0; k < corners; ++k)
    {
      sorted[c][k] = place[mesh.corners[c * corners + k]];
    }
    std::sort(sorted[c].begin(), sorted[c].begin() + std::ptrdiff_t(corners), std::greater<>());
  }
  std::ranges::sort(sorted);
  std::vector<std::int64_t> last(order.size(), -1), begins(sorted.size() + 1), ends(begins.size());
  for (std::size_t c = 0; c < sorted.size(); ++c)
  {
    for (std::size_t k = 0; k < corners; ++k)
    {
      std::int64_t& use = last[sorted[c][k]];
      begins[c] += use < 0;
      use = static_cast<std::int64_t>(c);
    }
  }
  for (const std::int64_t use : last)
  {
    ++ends[static_cast<std::size_t>(use) + 1];
  }
  std::int64_t alive = 0, width = 0;
  for (std::size_t c = 0; c < sorted.size(); ++c)
  {
    alive += begins[c] - ends[c];
    width = std::max(width, alive);
  }
  return width;
}

/** The breadth-first order of a mesh in memory; each component starts at one of its ends. */
inline std::vector<std::uint32_t> breadthFirstInCore(const CoreMesh& mesh)
{
  const auto neighbours = neighboursOf(mesh);
  std::vector<std::uint8_t> marks(mesh.points.size(), 0);
  std::vector<std::uint32_t> order, queue;
  const auto search = [&](std::uint32_t start, std::uint8_t mark)
  {
    queue.assign(1, start);
    marks[start] = mark;
    for (std::size_t i = 0; i < queue.size(); ++i)
    {
      for (const std::uint32_t other : neighbours[queue[i]])
      {
        if (marks[other] != mark)
        {
          marks[other] = mark;
          queue.push_back(other);
        }
      }
    }
  };
  for (std::uint32_t v = 0; v < marks.size(); ++v)
  {
    if (marks[v] == 0 && !neighbours[v].empty())
    {
      search(v, 1);
      search(queue.back(), 2);
      search(queue.back(), 3);
      order.insert(order.end(), queue.begin(), queue.end());
    }
  }
  return order;
}

} // namespace smg::testing
