// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/AxisOrder.h"

#include <algorithm>
#include <array>
#include <limits>

// The order `axis`: vertices sorted along the longest side of their bounds. Two passes over the
// pages, one for the bounds and one into an external sort (scalarOrder()), which works in the
// memory of the workspace.

namespace smg
{

namespace
{

template <class Real>
std::array<Real, 3> point(const PageView& page, std::uint32_t i)
{
  std::array<Real, 3> result;
  std::memcpy(result.data(), page.position(i, sizeof(result)), sizeof(result));
  return result;
}

template <class Real>
std::size_t longestAxis(VertexPages& pages, Workspace& workspace)
{
  std::array<double, 3> least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  forEachPage(pages, workspace,
    [&](const PageView& page)
    {
      for (std::uint32_t i = 0; i < page.vertices(); ++i)
      {
        const std::array<Real, 3> p = point<Real>(page, i);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          least[axis] = std::min<double>(least[axis], p[axis]);
          most[axis] = std::max<double>(most[axis], p[axis]);
        }
      }
    });
  // Of equal sides the first one.
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
    [axis](const PageView& page, std::uint32_t i) { return double(point<Real>(page, i)[axis]); });
}

} // namespace

OrderedVertices axisOrder(VertexPages& pages, Workspace& workspace)
{
  return pages.doublePositions() ? order<double>(pages, workspace) : order<float>(pages, workspace);
}

} // namespace smg
