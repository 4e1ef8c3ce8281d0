// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/CellOrder.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace smg
{

namespace
{

/** A cell by the ranks of its corners, the largest first; unused ones are 0. */
struct RankedCell
{
  std::array<std::uint32_t, 4> ranks{};
  std::uint32_t cell = 0;

  auto operator<=>(const RankedCell&) const = default;
};

RankedCell ranked(const IndexedMesh& mesh, const VertexRanks& ranks, std::uint32_t cell)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  RankedCell result;
  result.cell = cell;
  for (std::size_t k = 0; k < corners; ++k)
  {
    std::uint32_t rank = ranks[static_cast<std::size_t>(mesh.corners[cell * corners + k])];
    for (std::size_t i = 0; i <= k; ++i)
    {
      if (rank > result.ranks[i])
      {
        std::swap(rank, result.ranks[i]);
      }
    }
  }
  return result;
}

} // namespace

CellOrder sortCells(const IndexedMesh& mesh, const VertexRanks& ranks)
{
  const auto cells = static_cast<std::uint32_t>(mesh.cells());
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const auto largest = [&](std::uint32_t cell)
  {
    std::uint32_t rank = 0;
    for (std::size_t k = 0; k < corners; ++k)
    {
      rank = std::max(rank, ranks[static_cast<std::size_t>(mesh.corners[cell * corners + k])]);
    }
    return rank;
  };

  // A counting sort by the largest rank leaves few cells a rank to be sorted by the others.
  std::vector<std::uint32_t> begin(ranks.size() + 1);
  for (std::uint32_t cell = 0; cell < cells; ++cell)
  {
    ++begin[largest(cell)];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  CellOrder result{ std::vector<std::uint32_t>(cells), std::vector<std::uint8_t>(cells) };
  for (std::uint32_t cell = cells; cell-- > 0;)
  {
    result.cells[--begin[largest(cell)]] = cell;
  }

  std::vector<RankedCell> bucket;
  for (std::size_t rank = 0; rank < ranks.size(); ++rank)
  {
    bucket.clear();
    for (std::uint32_t i = begin[rank]; i < begin[rank + 1]; ++i)
    {
      bucket.push_back(ranked(mesh, ranks, result.cells[i]));
    }
    std::sort(bucket.begin(), bucket.end());
    for (std::size_t i = 0; i < bucket.size(); ++i)
    {
      result.cells[begin[rank] + i] = bucket[i].cell;
      result.duplicates[begin[rank] + i] = i > 0 && bucket[i].ranks == bucket[i - 1].ranks;
    }
  }
  return result;
}

} // namespace smg
