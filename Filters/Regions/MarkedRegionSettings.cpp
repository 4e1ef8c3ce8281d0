// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/MarkedRegionSettings.h"

#include "smg/Error.h"

#include <cmath>

namespace smg
{

Where MarkedRegionSettings::where() const
{
  if (this->isBoundary())
  {
    return OnBoundary{};
  }
  if (this->tag)
  {
    return ColumnTag{ this->array, *this->tag };
  }
  return ColumnMask{ this->array };
}

bool MarkedRegionSettings::isMarked(double value, bool isFloat) const
{
  if (this->tag)
  {
    return value == (isFloat ? static_cast<double>(static_cast<float>(*this->tag)) : *this->tag);
  }
  if (std::isnan(value))
  {
    throw Error("The array " + this->array +
                " of the region has a value that is not a number: choose another array.");
  }
  return value != 0.0;
}

} // namespace smg
