// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/VertexRanks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace smg
{

namespace
{

/** Searches over the edges that reuse their memory. */
class Search
{
public:
  Search(const IndexedMesh& mesh, const VertexCells& cells)
    : Mesh(mesh)
    , Cells(cells)
    , Corners(static_cast<std::size_t>(cornersOf(mesh.cellType)))
    , Mark(static_cast<std::size_t>(mesh.vertices()), 0)
  {
    this->Queue.reserve(this->Mark.size());
  }

  bool visited(std::int64_t vertex) const { return this->Mark[static_cast<std::size_t>(vertex)]; }

  /** Searches the component of `start`; its vertices follow place `begin` of the queue. */
  void run(std::uint32_t start, std::size_t begin)
  {
    this->Queue.resize(begin);
    ++this->Epoch;
    this->visit(start);
    for (std::size_t head = begin; head < this->Queue.size(); ++head)
    {
      for (const std::uint32_t cell : this->Cells.around(this->Queue[head]))
      {
        const std::int64_t* corners = this->Mesh.corners.data() + cell * this->Corners;
        for (std::size_t k = 0; k < this->Corners; ++k)
        {
          if (this->Mark[static_cast<std::size_t>(corners[k])] != this->Epoch)
          {
            this->visit(static_cast<std::uint32_t>(corners[k]));
          }
        }
      }
    }
  }

  std::size_t size() const { return this->Queue.size(); }
  std::uint32_t last() const { return this->Queue.back(); }

  /** Turns the queue into ranks; the search is over. */
  VertexRanks ranks()
  {
    for (std::size_t i = 0; i < this->Queue.size(); ++i)
    {
      this->Mark[this->Queue[i]] = static_cast<std::uint32_t>(i);
    }
    return std::move(this->Mark);
  }

private:
  void visit(std::uint32_t vertex)
  {
    this->Mark[vertex] = this->Epoch;
    this->Queue.push_back(vertex);
  }

  const IndexedMesh& Mesh;
  const VertexCells& Cells;
  const std::size_t Corners;
  std::vector<std::uint32_t> Queue;
  /** The number of the search that saw the vertex last; 0: none. */
  std::vector<std::uint32_t> Mark;
  std::uint32_t Epoch = 0;
};

} // namespace

BreadthFirstResult breadthFirstRanks(
  const IndexedMesh& mesh, const VertexCells& cells, const std::function<void(double)>& tick)
{
  BreadthFirstResult result;
  Search search(mesh, cells);
  const std::int64_t vertices = mesh.vertices();
  std::size_t done = 0;
  for (std::int64_t vertex = 0; vertex < vertices; ++vertex)
  {
    if (search.visited(vertex) || cells.around(vertex).empty())
    {
      continue;
    }
    search.run(static_cast<std::uint32_t>(vertex), done);
    for (int i = 0; i < 2; ++i)
    {
      tick(static_cast<double>(done + (search.size() - done) * (i + 1) / 3) /
           static_cast<double>(vertices));
      search.run(search.last(), done);
    }
    done = search.size();
    ++result.components;
  }
  result.ranks = search.ranks();
  return result;
}

VertexRanks axisRanks(const IndexedMesh& mesh)
{
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const std::int64_t corner : mesh.corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double x = mesh.positions[static_cast<std::size_t>(corner) * 3 + axis];
      low[axis] = std::min(low[axis], x);
      high[axis] = std::max(high[axis], x);
    }
  }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    // Halved, because the side of an enormous box is more than a double can hold.
    longest =
      high[axis] / 2 - low[axis] / 2 > high[longest] / 2 - low[longest] / 2 ? axis : longest;
  }
  std::vector<std::uint32_t> order(static_cast<std::size_t>(mesh.vertices()));
  std::iota(order.begin(), order.end(), 0u);
  const double* x = mesh.positions.data() + longest;
  std::sort(order.begin(), order.end(),
    [x](std::uint32_t a, std::uint32_t b)
    {
      const double xa = x[std::size_t(a) * 3];
      const double xb = x[std::size_t(b) * 3];
      return xa != xb ? xa < xb : a < b;
    });
  VertexRanks ranks(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    ranks[order[i]] = static_cast<std::uint32_t>(i);
  }
  return ranks;
}

VertexRanks firstUseRanks(const IndexedMesh& mesh)
{
  constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();
  VertexRanks ranks(static_cast<std::size_t>(mesh.vertices()), None);
  std::uint32_t next = 0;
  for (const std::int64_t corner : mesh.corners)
  {
    std::uint32_t& rank = ranks[static_cast<std::size_t>(corner)];
    if (rank == None)
    {
      rank = next++;
    }
  }
  return ranks;
}

} // namespace smg
