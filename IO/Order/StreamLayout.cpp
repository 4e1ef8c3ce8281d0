// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/StreamLayout.h"

#include "IO/Order/CellOrder.h"
#include "IO/Order/CellShape.h"
#include "IO/Order/VertexCells.h"
#include "IO/Order/VertexRanks.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>

namespace smg
{

namespace
{

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

/** Counts the edges from each vertex to those with a larger index. */
void countEdges(const IndexedMesh& mesh, const VertexCells& around, StreamLayout& layout)
{
  layout.boundaryEdges = 0;
  layout.nonManifoldEdges = 0;
  std::vector<std::int64_t> others;
  for (std::int64_t vertex = 0; vertex < mesh.vertices(); ++vertex)
  {
    others.clear();
    for (const std::uint32_t cell : around.around(vertex))
    {
      const std::int64_t* corners = mesh.corners.data() + std::size_t(cell) * 3;
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      {
        std::copy_if(corners, corners + 3, std::back_inserter(others),
          [vertex](std::int64_t corner) { return corner > vertex; });
      }
    }
    std::sort(others.begin(), others.end());
    for (std::size_t i = 0; i < others.size();)
    {
      const std::size_t begin = i;
      while (i < others.size() && others[i] == others[begin])
      {
        ++i;
      }
      layout.boundaryEdges += i - begin == 1;
      layout.nonManifoldEdges += i - begin > 2;
    }
  }
}

/** Ranks by the order that is wanted; counts components and edges on the way. */
VertexRanks rank(
  const IndexedMesh& mesh, StreamOrder order, StreamLayout& layout, Progress& progress)
{
  BreadthFirstResult search;
  {
    const VertexCells around(mesh);
    progress.update(0.15);
    search = breadthFirstRanks(
      mesh, around, [&progress](double done) { progress.update(0.15 + 0.45 * done); });
    layout.components = search.components;
    if (mesh.cellType == CellType::Triangle)
    {
      countEdges(mesh, around, layout);
    }
  }
  progress.update(0.65);
  if (order == StreamOrder::BreadthFirst)
  {
    return std::move(search.ranks);
  }
  search.ranks = {};
  return order == StreamOrder::Axis ? axisRanks(mesh) : firstUseRanks(mesh);
}

/** The flags of cells in the order of the mesh, from those of a sorted order. */
std::vector<std::uint8_t> inMeshOrder(const CellOrder& sorted)
{
  std::vector<std::uint8_t> result(sorted.cells.size());
  for (std::size_t i = 0; i < sorted.cells.size(); ++i)
  {
    result[sorted.cells[i]] = sorted.duplicates[i];
  }
  return result;
}

/** Numbers the vertices by first use and notes their last cells. */
void numberVertices(const IndexedMesh& mesh, StreamLayout& layout)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  layout.streamIndex.assign(static_cast<std::size_t>(mesh.vertices()), None);
  layout.vertices.reserve(layout.streamIndex.size());
  layout.lastCell.reserve(layout.streamIndex.size());
  for (std::size_t cell = 0; cell < layout.cells.size(); ++cell)
  {
    for (std::size_t k = 0; k < corners; ++k)
    {
      const auto vertex =
        static_cast<std::uint32_t>(mesh.corners[layout.cells[cell] * corners + k]);
      std::uint32_t& index = layout.streamIndex[vertex];
      if (index == None)
      {
        index = static_cast<std::uint32_t>(layout.vertices.size());
        layout.vertices.push_back(vertex);
        layout.lastCell.push_back(0);
      }
      layout.lastCell[index] = static_cast<std::uint32_t>(cell);
    }
  }
  layout.isolatedVertices = mesh.vertices() - static_cast<std::int64_t>(layout.vertices.size());
}

/** Adds the degenerate cells to the flags, and counts. */
void flagCells(const IndexedMesh& mesh, StreamLayout& layout)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::array<std::array<double, 3>, 4> points;
  for (std::size_t i = 0; i < layout.cells.size(); ++i)
  {
    const std::int64_t* cell = mesh.corners.data() + layout.cells[i] * corners;
    for (std::size_t k = 0; k < corners; ++k)
    {
      std::copy_n(mesh.positions.data() + cell[k] * 3, 3, points[k].data());
    }
    layout.duplicateCells += layout.flags[i] != 0;
    if (isDegenerate({ cell, corners }, { points.data(), corners }))
    {
      layout.flags[i] |= DegenerateCell;
      ++layout.degenerateCells;
    }
  }
}

} // namespace

StreamLayout layOut(const IndexedMesh& mesh, StreamOrder order, const ProgressFunction& progress)
{
  requireAvailable(order);
  if (mesh.vertices() >= None || mesh.cells() >= None)
  {
    throw Error(
      "A mesh of " + std::to_string(mesh.vertices()) + " vertices and " +
      std::to_string(mesh.cells()) +
      " cells is too large to be brought into order in memory: at most 4294967294 of each.");
  }
  Progress reported(progress);
  StreamLayout layout;
  {
    CellOrder sorted = sortCells(mesh, rank(mesh, order, layout, reported));
    reported.update(0.85);
    if (order == StreamOrder::Keep)
    {
      layout.flags = inMeshOrder(sorted);
      layout.cells = std::move(sorted.cells);
      std::iota(layout.cells.begin(), layout.cells.end(), 0u);
    }
    else
    {
      layout.flags = std::move(sorted.duplicates);
      layout.cells = std::move(sorted.cells);
    }
  }
  for (std::uint8_t& flag : layout.flags)
  {
    flag = flag ? DuplicateCell : 0;
  }
  numberVertices(mesh, layout);
  flagCells(mesh, layout);
  reported.update(1.0);
  return layout;
}

} // namespace smg
