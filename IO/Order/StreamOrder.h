// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg
{

/** The order that a conversion brings a mesh into. */
enum class StreamOrder
{
  BreadthFirst, ///< from planned starts, component after component: `bfs`
  Axis,         ///< along the longest side of the bounds: `axis`
  Keep,         ///< the order of the cells in the file: `keep`
  Spectral      ///< by the Fiedler vector: `spectral`
};

/** The order with this name. Throws Error naming the orders that there are. */
StreamOrder streamOrder(std::string_view name);

/** "bfs", "axis", "keep" or "spectral". */
std::string_view nameOf(StreamOrder order);

} // namespace smg
