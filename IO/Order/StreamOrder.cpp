// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "smg/Error.h"

namespace smg
{

StreamOrder streamOrder(std::string_view name)
{
  for (const StreamOrder order :
    { StreamOrder::BreadthFirst, StreamOrder::Axis, StreamOrder::Keep, StreamOrder::Spectral })
  {
    if (name == nameOf(order))
    {
      return order;
    }
  }
  throw Error("There is no order '" + std::string(name) + "': choose bfs, spectral, axis or keep.");
}

std::string_view nameOf(StreamOrder order)
{
  constexpr std::string_view names[] = { "bfs", "axis", "keep", "spectral" };
  return names[static_cast<int>(order)];
}

} // namespace smg
