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
  std::vector<std::size_t> begins; ///< one more than there are vertices
  std::vector<std::uint32_t> all;

  std::size_t vertices() const { return this->begins.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t vertex) const
  {
    return std::span(this->all).subspan(
      this->begins[vertex], this->begins[vertex + 1] - this->begins[vertex]);
  }
};

/** Of a mesh: vertices that have a cell in common, ascending. */
Neighbours neighboursOf(const IndexedTestMesh& mesh);
/** Of a graph with these edges, each given once or more often. */
Neighbours neighboursOf(
  std::size_t vertices, std::span<const std::pair<std::uint32_t, std::uint32_t>> edges);

/**
 * The vertices in a breadth-first order, component after component, each begun at the last vertex
 * of a search that was begun at the last vertex of another one.
 */
std::vector<std::uint32_t> inCoreBreadthFirst(const Neighbours& neighbours);

/** Levels of a breadth-first search from sources (vertex, level); NoIndex: not reached. */
std::vector<std::uint32_t> inCoreLevels(
  const Neighbours& neighbours, std::span<const std::pair<std::uint32_t, std::uint32_t>> sources);

std::int64_t inCoreComponents(const Neighbours& neighbours);

/** What whoever streams an order holds: see the words span and window. */
struct OrderSize
{
  std::int64_t span = 0;
  double meanWindow = 0;
};
OrderSize orderSize(const Neighbours& neighbours, std::span<const std::uint32_t> order);

} // namespace smg::testing
