// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedCells.h"

#include "Solver/Distributed/Rendezvous.h"

#include <algorithm>
#include <array>
#include <vector>

namespace smg
{
namespace
{

/** A cell of a part. */
struct PartCell
{
  std::array<std::int64_t, 4> key; ///< stream indices, ascending; of a triangle the last one is 0
};

} // namespace

std::int64_t repeatedCells(const SharedVertices& vertices, const MeshPart& part)
{
  const std::vector<std::int64_t>& corners = part.block.corners;
  const auto each = static_cast<std::size_t>(cornersOf(part.info.cellType));
  std::vector<PartCell> items;
  for (std::size_t c = 0; c < corners.size(); c += each)
  {
    const auto cell = std::span(corners).subspan(c, each);
    // Another process can only have the cell if it has all corners.
    if (!std::ranges::all_of(cell, [&](std::int64_t v) { return vertices.isShared(v); }))
    {
      continue;
    }
    PartCell item{};
    std::ranges::transform(cell, item.key.begin(), [&](std::int64_t v) { return vertices.id(v); });
    std::sort(item.key.begin(), item.key.begin() + static_cast<std::ptrdiff_t>(each));
    items.push_back(item);
  }
  std::int64_t repeated = 0;
  rendezvous<std::uint8_t>(vertices, items,
    [&](auto meetings)
    {
      const auto isElsewhere = [&](const auto& meeting)
      { return meeting.process != meetings.front().process; };
      repeated += std::ranges::any_of(meetings, isElsewhere) ? 1 : 0;
    });
  vertices.team().sum({ &repeated, 1 });
  return repeated;
}

} // namespace smg
