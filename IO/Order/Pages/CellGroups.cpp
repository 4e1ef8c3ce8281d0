// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/CellGroups.h"

#include <algorithm>

namespace smg
{

CellGroups::CellGroups(Workspace& workspace, RankRange range, std::int64_t groupVertices,
  std::size_t corners, std::int64_t memory)
  : Corners(corners)
  , Begin(static_cast<std::uint32_t>(range.begin))
  , Size(static_cast<std::uint32_t>(range.size()))
  , GroupVertices(static_cast<std::uint32_t>(groupVertices))
  , Cells(workspace,
      static_cast<int>(
        std::max<std::int64_t>(1, (range.size() + groupVertices - 1) / groupVertices)),
      memory)
{
}

RankRange CellGroups::range(int group) const
{
  const std::int64_t begin = std::int64_t(this->Begin) + std::int64_t(group) * this->GroupVertices;
  return { begin, std::min(begin + this->GroupVertices, std::int64_t(this->Begin) + this->Size) };
}

} // namespace smg
