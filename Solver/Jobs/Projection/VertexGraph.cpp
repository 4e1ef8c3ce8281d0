// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Projection/VertexGraph.h"

#include <utility>

namespace smg
{
namespace
{

/** The cells at each vertex: from begins[vertex] to begins[vertex + 1] in `cells`. */
struct Incidence
{
  std::vector<std::int64_t> begins;
  std::vector<std::int32_t> cells;
};

Incidence incidence(
  std::span<const std::int32_t> corners, std::size_t cornersOfCell, std::int64_t vertices)
{
  Incidence at;
  at.cells.resize(corners.size());
  // Counting sort: counts, then ends; filling backwards leaves the begins.
  at.begins.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const std::int32_t corner : corners)
  {
    ++at.begins[corner];
  }
  std::int64_t end = 0;
  for (std::int64_t& begin : at.begins)
  {
    end += begin;
    begin = end;
  }
  for (std::size_t i = corners.size(); i-- > 0;)
  {
    at.cells[--at.begins[corners[i]]] = static_cast<std::int32_t>(i / cornersOfCell);
  }
  return at;
}

} // namespace

VertexGraph::VertexGraph(
  std::span<const std::int32_t> corners, int cornersOfCell, std::int64_t vertices)
{
  const auto count = static_cast<std::size_t>(cornersOfCell);
  const Incidence at = incidence(corners, count, vertices);
  std::vector<std::int32_t> lastSeenFrom(static_cast<std::size_t>(vertices), -1);
  this->Begins.reserve(static_cast<std::size_t>(vertices) + 1);
  this->Begins.push_back(0);
  // On a surface, the number of corners plus that of boundary edges.
  this->Neighbours.reserve(corners.size() + corners.size() / 8);
  for (std::int32_t vertex = 0; vertex < vertices; ++vertex)
  {
    lastSeenFrom[vertex] = vertex;
    for (std::int64_t k = at.begins[vertex]; k < at.begins[vertex + 1]; ++k)
    {
      for (const std::int32_t other : corners.subspan(at.cells[k] * count, count))
      {
        if (std::exchange(lastSeenFrom[other], vertex) != vertex)
        {
          this->Neighbours.push_back(other);
        }
      }
    }
    this->Begins.push_back(static_cast<std::int64_t>(this->Neighbours.size()));
  }
}

std::size_t VertexGraph::walk(
  int rings, std::vector<std::int32_t>& found, std::vector<std::uint8_t>& isFound) const
{
  std::size_t begin = 0;
  std::size_t end = found.size();
  for (int ring = 0; ring < rings; ++ring)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      for (const std::int32_t next : this->neighbours(found[i]))
      {
        if (!isFound[next])
        {
          isFound[next] = 1;
          found.push_back(next);
        }
      }
    }
    begin = end;
    end = found.size();
  }
  return begin;
}

} // namespace smg
