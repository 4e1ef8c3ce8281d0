// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg::testing
{

/** The neighbours of the vertices of a graph, in memory. */
struct Neighbours
{
  std::vector<std::size_t> begins; ///< one more than the number of vertices
  std::vector<std::uint32_t> all;

  std::size_t vertices() const { return this->begins.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t vertex) const
  {
    return std::span(this->all).subspan(
      this->begins[vertex], this->begins[vertex + 1] - this->begins[vertex]);
  }
};

/** The graph of a mesh: vertices with a common cell, in ascending order. */
Neighbours neighboursOf(const IndexedTestMesh& mesh);
/** The graph with these edges, which may contain duplicates. */
Neighbours neighboursOf(
  std::size_t vertices, std::span<const std::pair<std::uint32_t, std::uint32_t>> edges);

/** The vertices in a breadth-first order, component by component. The search in each component
 * starts at the last vertex of a search that started at the last vertex of another one. */
std::vector<std::uint32_t> inCoreBreadthFirst(const Neighbours& neighbours);

/** Levels of a breadth-first search from sources (vertex, level); NoIndex: not reached. */
std::vector<std::uint32_t> inCoreLevels(
  const Neighbours& neighbours, std::span<const std::pair<std::uint32_t, std::uint32_t>> sources);

std::int64_t inCoreComponents(const Neighbours& neighbours);

/** The span and the window of an order. */
struct OrderSize
{
  std::int64_t span = 0;
  double meanWindow = 0;
};
OrderSize orderSize(const Neighbours& neighbours, std::span<const std::uint32_t> order);

} // namespace smg::testing
