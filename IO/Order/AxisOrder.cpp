// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/AxisOrder.h"

#include "IO/Order/ScalarOrder.h"

#include <algorithm>
#include <array>
#include <limits>

namespace smg
{

namespace
{

template <class Real>
std::array<Real, 3> point(std::span<const std::byte> positions, std::size_t i)
{
  std::array<Real, 3> result;
  std::memcpy(result.data(), positions.data() + i * sizeof(result), sizeof(result));
  return result;
}

template <class Real>
std::size_t longestAxis(VertexPages& pages, Workspace& workspace)
{
  std::array<double, 3> least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  forEachPage(pages, workspace,
    [&](std::int64_t page, std::span<const std::byte> bytes)
    {
      const auto positions = pages.positions(page, bytes);
      for (std::size_t i = 0; i < pages.verticesOf(page); ++i)
      {
        const std::array<Real, 3> p = point<Real>(positions, i);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          least[axis] = std::min<double>(least[axis], p[axis]);
          most[axis] = std::max<double>(most[axis], p[axis]);
        }
      }
    });
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    longest = most[axis] - least[axis] > most[longest] - least[longest] ? axis : longest;
  }
  return longest;
}

template <class Real>
OrderedVertices order(VertexPages& pages, Workspace& workspace)
{
  const std::size_t axis = longestAxis<Real>(pages, workspace);
  return scalarOrder<Real>(pages, workspace,
    [&pages, axis](std::int64_t page, std::span<const std::byte> bytes, std::size_t i)
    { return double(point<Real>(pages.positions(page, bytes), i)[axis]); });
}

} // namespace

OrderedVertices axisOrder(VertexPages& pages, Workspace& workspace)
{
  return pages.doublePositions() ? order<double>(pages, workspace) : order<float>(pages, workspace);
}

} // namespace smg
