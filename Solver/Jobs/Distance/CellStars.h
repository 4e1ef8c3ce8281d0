// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace smg
{

/** The cells of each vertex, of some vertices and cells that are numbered from 0. The memory is
 * that of the caller. */
struct CellStars
{
  std::uint32_t* corners = nullptr; ///< of the cells: places in a window
  std::uint32_t* start = nullptr;   ///< of the cells of a vertex in `list`; one more than vertices
  std::uint32_t* list = nullptr;    ///< cells

  /** Bytes for so many vertices and corners of cells. */
  static constexpr std::int64_t bytes(std::int64_t vertices, std::int64_t corners)
  {
    return (vertices + 1 + 2 * corners) * std::int64_t(sizeof(std::uint32_t));
  }

  std::span<const std::uint32_t> of(std::uint32_t vertex) const
  {
    return { this->list + this->start[vertex], this->list + this->start[vertex + 1] };
  }

  /** Lists the cells, in their order; `numberOf(corner)` is the number of a vertex by its place. */
  template <int Corners>
  void build(std::int64_t vertices, std::int64_t cells, auto numberOf)
  {
    std::fill_n(this->start, vertices + 1, 0U);
    const std::int64_t all = Corners * cells;
    for (std::int64_t c = 0; c < all; ++c)
    {
      ++this->start[numberOf(this->corners[c])];
    }
    for (std::int64_t v = 0; v < vertices; ++v)
    {
      this->start[v + 1] += this->start[v];
    }
    // From the last cell to the first one, so that the ends of the lists become their starts.
    for (std::int64_t c = all - 1; c >= 0; --c)
    {
      this->list[--this->start[numberOf(this->corners[c])]] =
        static_cast<std::uint32_t>(c / Corners);
    }
  }
};

} // namespace smg
