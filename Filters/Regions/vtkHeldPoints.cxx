// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkHeldPoints.h"

#include "vtkPointSet.h"

#include <array>

namespace smg
{

HeldPoints heldByIds(std::span<const std::int64_t> ids, const SoughtIds& sought)
{
  HeldPoints held;
  held.by.reserve(ids.size());
  for (const std::int64_t id : ids)
  {
    held.by.push_back(sought.numberOf(id));
  }
  held.holders = sought.size();
  return held;
}

HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection)
{
  HeldPoints held;
  held.by.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    std::array<double, 3> point;
    mesh.GetPoint(static_cast<vtkIdType>(i), point.data());
    held.by.push_back(projection.influencing(indices[i], point));
  }
  for (const PointProjection::Projected& projected : projection.projected())
  {
    held.anchors.insert(held.anchors.end(), projected.position.begin(), projected.position.end());
  }
  held.holders = static_cast<std::int64_t>(projection.projected().size());
  return held;
}

} // namespace smg
