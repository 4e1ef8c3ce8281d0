// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/vtkHandleDelivery.h"

#include "Filters/Regions/vtkHandleArrays.h"
#include "smg/Error.h"

#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace smg
{
namespace
{

/** Moves the point by the displacement from the anchor to the target; exact at the anchor. */
std::array<double, 3> moved(
  const std::array<double, 3>& point, const double* anchor, const double* target)
{
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
  {
    result[k] = target[k] + (point[k] - anchor[k]);
  }
  return result;
}

} // namespace

void HandleTargets::check() const
{
  if (!std::all_of(this->ofHolders.begin(), this->ofHolders.end(),
        [](double number) { return std::isfinite(number); }))
  {
    throw Error("A point target of the handle is not a finite number.");
  }
}

void deliverHandle(
  vtkPointSet& piece, const HeldPoints& held, const HandleTargets& targets, vtkPointSet& output)
{
  const std::vector<double>& ofHolders = targets.ofHolders;
  if (!ofHolders.empty() && !held.by.empty() &&
      static_cast<std::int64_t>(ofHolders.size()) != 3 * held.holders)
  {
    throw Error("The handle has " + std::to_string(ofHolders.size() / 3) + " point targets for " +
                std::to_string(held.holders) + " points: give one for each, or none.");
  }
  const HandleMotion& motion = targets.motion;
  HandleArrays arrays(*piece.GetPointData(), piece.GetNumberOfPoints());
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    const std::int64_t holder = held.by[i];
    if (holder < 0)
    {
      continue;
    }
    std::array<double, 3> point;
    piece.GetPoint(static_cast<vtkIdType>(i), point.data());
    const double* anchor = held.anchors.empty() ? point.data() : &held.anchors[3 * holder];
    const std::array<double, 3> target =
      ofHolders.empty() ? motion.apply(point) : moved(point, anchor, &ofHolders[3 * holder]);
    arrays.hold(static_cast<vtkIdType>(i), target, motion.rotation(), motion.logScale());
  }
  output.ShallowCopy(&piece);
  arrays.addTo(*output.GetPointData());
}

} // namespace smg
