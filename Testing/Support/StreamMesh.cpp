// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/StreamMesh.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace smg::testing
{
namespace
{

/** The cells around each vertex, one list after the other. */
struct Stars
{
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> cells;

  explicit Stars(const IndexedTestMesh& mesh)
    : first(mesh.vertices() + 1, 0)
    , cells(mesh.corners.size())
  {
    for (const std::int64_t v : mesh.corners)
    {
      ++this->first[v + 1];
    }
    std::partial_sum(this->first.begin(), this->first.end(), this->first.begin());
    std::vector<std::int64_t> next(this->first.begin(), this->first.end() - 1);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    {
      this->cells[next[mesh.corners[i]]++] =
        static_cast<std::int64_t>(i) / cornersOf(mesh.cellType);
    }
  }
};

/**
 * The position of every vertex in a breadth-first search from the first vertex of each component.
 */
std::vector<std::int64_t> breadthFirstPlaces(const IndexedTestMesh& mesh)
{
  const Stars stars(mesh);
  const int size = cornersOf(mesh.cellType);
  std::vector<std::int64_t> place(mesh.vertices(), -1);
  std::vector<std::int64_t> queue;
  const auto visit = [&](std::int64_t v)
  {
    if (place[v] < 0)
    {
      place[v] = static_cast<std::int64_t>(queue.size());
      queue.push_back(v);
    }
  };
  std::size_t done = 0;
  for (std::int64_t start = 0; start < mesh.vertices(); ++start)
  {
    visit(start);
    for (; done < queue.size(); ++done)
    {
      const std::int64_t v = queue[done];
      for (std::int64_t s = stars.first[v]; s < stars.first[v + 1]; ++s)
      {
        const auto corners = mesh.corners.begin() + size * stars.cells[s];
        std::for_each(corners, corners + size, visit);
      }
    }
  }
  return place;
}

/** The cells, sorted by the positions of their vertices, the largest first. */
std::vector<std::int64_t> breadthFirstCells(const IndexedTestMesh& mesh)
{
  const int size = cornersOf(mesh.cellType);
  const std::vector<std::int64_t> place = breadthFirstPlaces(mesh);
  std::vector<std::array<std::int64_t, 4>> keys(mesh.cells());
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    keys[c].fill(-1);
    for (int k = 0; k < size; ++k)
    {
      keys[c][k] = place[mesh.corners[size * c + k]];
    }
    std::sort(keys[c].begin(), keys[c].end(), std::greater<>());
  }
  std::vector<std::int64_t> order(mesh.cells());
  std::iota(order.begin(), order.end(), std::int64_t(0));
  std::stable_sort(
    order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) { return keys[a] < keys[b]; });
  return order;
}

} // namespace

StreamMesh toStream(const IndexedTestMesh& mesh, TestOrder order)
{
  std::vector<std::int64_t> cells;
  if (order == TestOrder::BreadthFirst)
  {
    cells = breadthFirstCells(mesh);
  }
  else
  {
    cells.resize(mesh.cells());
    std::iota(cells.begin(), cells.end(), std::int64_t(0));
  }

  StreamMesh stream;
  stream.cellType = mesh.cellType;
  const int size = cornersOf(mesh.cellType);
  std::vector<std::int64_t> index(mesh.vertices(), -1);
  for (const std::int64_t cell : cells)
  {
    for (int k = 0; k < size; ++k)
    {
      const std::int64_t v = mesh.corners[size * cell + k];
      if (index[v] < 0)
      {
        index[v] = stream.vertices();
        stream.originalIds.push_back(v);
        const auto p = mesh.positions.begin() + 3 * v;
        stream.positions.insert(stream.positions.end(), p, p + 3);
      }
      stream.corners.push_back(index[v]);
    }
  }
  return stream;
}

StreamMesh collect(MeshSource& source)
{
  StreamMesh mesh;
  mesh.cellType = source.info().cellType;
  mesh.groups = source.info().groups;
  for (const ColumnSpec& spec : source.info().vertexColumns)
  {
    mesh.vertexColumns.push_back({ spec, {} });
  }
  for (const ColumnSpec& spec : source.info().cellColumns)
  {
    mesh.cellColumns.push_back({ spec, {} });
  }
  const auto append = [](auto& to, const auto& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  MeshBlock block;
  while (source.next(block))
  {
    append(mesh.positions, block.positions);
    append(mesh.corners, block.corners);
    for (std::size_t i = 0; i < mesh.vertexColumns.size(); ++i)
    {
      append(mesh.vertexColumns[i].bytes, block.vertexColumns[i].bytes);
    }
    for (std::size_t i = 0; i < mesh.cellColumns.size(); ++i)
    {
      append(mesh.cellColumns[i].bytes, block.cellColumns[i].bytes);
    }
  }
  mesh.originalIds.resize(mesh.vertices());
  std::iota(mesh.originalIds.begin(), mesh.originalIds.end(), std::int64_t(0));
  return mesh;
}

} // namespace smg::testing
