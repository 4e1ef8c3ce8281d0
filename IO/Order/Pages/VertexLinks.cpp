// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexLinks.h"

#include <algorithm>

namespace smg
{

VertexLinks::VertexLinks(
  Workspace& workspace, const CellGroups& groups, int group, std::size_t corners)
  : Range(groups.range(group))
  , Corners(corners)
  , Begins(workspace.pool(), static_cast<std::size_t>(this->Range.size() + 1) * 8)
{
  const auto count = static_cast<std::size_t>(this->Range.size());
  const auto first = static_cast<std::uint32_t>(this->Range.begin);
  std::uint64_t* begins = this->begins();
  std::fill_n(begins, count + 1, 0);
  groups.forEach(group,
    [&](std::span<const std::uint32_t> cell)
    {
      for (const std::uint32_t rank : cell)
      {
        const std::uint32_t place = rank - first;
        if (place < count)
        {
          ++begins[place];
        }
      }
    });
  std::uint64_t sum = 0;
  for (std::size_t place = 0; place <= count; ++place)
  {
    const std::uint64_t link = begins[place] * (corners - 1);
    this->Largest = std::max(this->Largest, static_cast<std::size_t>(link));
    begins[place] = sum;
    sum += link;
  }
}

std::int64_t VertexLinks::size(RankRange part) const
{
  const std::uint64_t* begins = this->begins() - this->Range.begin;
  return static_cast<std::int64_t>(begins[part.end] - begins[part.begin]);
}

void VertexLinks::load(Workspace& workspace, const CellGroups& groups, int group)
{
  this->Ranks = Buffer(workspace.pool(), static_cast<std::size_t>(this->bytes()));
  const auto count = static_cast<std::size_t>(this->Range.size());
  const auto first = static_cast<std::uint32_t>(this->Range.begin);
  std::uint64_t* begins = this->begins();
  std::uint32_t* ranks = this->ranks();
  groups.forEach(group,
    [&](std::span<const std::uint32_t> cell)
    {
      for (std::size_t k = 0; k < cell.size(); ++k)
      {
        const std::uint32_t place = cell[k] - first;
        if (place < count)
        {
          for (std::size_t other = 0; other < cell.size(); ++other)
          {
            if (other != k)
            {
              ranks[begins[place]++] = cell[other];
            }
          }
        }
      }
    });
  // Each offset has moved to the position of the next one.
  std::copy_backward(begins, begins + count, begins + count + 1);
  begins[0] = 0;
}

} // namespace smg
