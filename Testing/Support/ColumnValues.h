// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include <vector>

namespace smg::testing
{

/** All components of a column, or this one, as doubles. */
inline std::vector<double> valuesOf(const Column& column, int component = -1)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < column.tuples(); ++i)
  {
    for (int k = 0; k < column.spec.components; ++k)
    {
      if (component < 0 || component == k)
      {
        values.push_back(column.value(i, k));
      }
    }
  }
  return values;
}

} // namespace smg::testing
