// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"

#include "smg/Error.h"

#include <cmath>
#include <string>

namespace smg
{

std::array<float, 3> singlePrecision(
  std::span<const double, 3> position, std::int64_t vertex, const std::string& what)
{
  std::array<float, 3> rounded{};
  for (std::size_t axis = 0; axis < 3; axis++)
  {
    rounded[axis] = static_cast<float>(position[axis]);
    if (!std::isfinite(rounded[axis]))
    {
      throw Error(
        what + ": coordinate " + std::to_string(axis) + " of vertex " + std::to_string(vertex) +
        " is too large for the single precision of what is written: use smaller coordinates, or a "
        ".vsm file of double precision.");
    }
  }
  return rounded;
}

} // namespace smg
