// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/PointRegionSettings.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{

void PointRegionSettings::check(bool hasSelection) const
{
  if (this->kind == Kind::Selection && !hasSelection)
  {
    throw Error("The region has no selection: select something on its input and copy the active "
                "selection.");
  }
  if (this->kind == Kind::Ids)
  {
    if (this->ids.empty())
    {
      throw Error("The region has no ids: name at least one point in Ids.");
    }
    const std::int64_t lowest = *std::min_element(this->ids.begin(), this->ids.end());
    if (lowest < 0)
    {
      throw Error("The id " + std::to_string(lowest) + " of the region is negative.");
    }
  }
  if (this->kind == Kind::Points && this->points.empty())
  {
    throw Error("The region has no points: name at least one place in Points.");
  }
  if (!std::isfinite(this->radius))
  {
    throw Error("The radius of the region is not a finite number.");
  }
}

} // namespace smg
