// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedEdges.h"

#include "Solver/Distributed/Rendezvous.h"

#include <array>

namespace smg
{
namespace
{

/** An edge of cells of a part. */
struct PartEdge
{
  std::array<std::int64_t, 2> key; ///< stream indices
  WeightedEdges::Sum sum;
};

} // namespace

void joinSharedEdges(const SharedVertices& vertices, WeightedEdges& edges)
{
  const auto forShared = [&](auto visit)
  {
    for (std::int64_t low = 0; low < vertices.vertices(); ++low)
    {
      if (vertices.isShared(low))
      {
        edges.visit(low,
          [&](std::int64_t high, WeightedEdges::Sum& sum)
          {
            if (vertices.isShared(high))
            {
              visit(low, high, sum);
            }
          });
      }
    }
  };
  std::vector<PartEdge> items;
  forShared(
    [&](std::int64_t low, std::int64_t high, const WeightedEdges::Sum& sum) {
      items.push_back({ { vertices.id(low), vertices.id(high) }, sum });
    });
  const auto sums = rendezvous<WeightedEdges::Sum>(vertices, items,
    [&edges](auto meetings)
    {
      WeightedEdges::Sum& whole = meetings.front().answer;
      whole = meetings.front().item.sum;
      for (auto& meeting : meetings.subspan(1))
      {
        edges.join(whole, meeting.item.sum);
        meeting.answer = { WeightedEdges::Elsewhere, 0.0 };
      }
    });
  auto next = sums.begin();
  forShared([&next](std::int64_t, std::int64_t, WeightedEdges::Sum& sum) { sum = *next++; });
}

} // namespace smg
