// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Replaces the vertices of the minima and maxima of a report by numberOf(vertex). */
template <class NumberOf>
void renumberExtremes(Report& report, NumberOf numberOf)
{
  for (std::vector<Report::Extreme>* extremes : { &report.minimum, &report.maximum })
  {
    for (Report::Extreme& extreme : *extremes)
    {
      // Negative if all values are NaN.
      extreme.vertex = extreme.vertex < 0 ? extreme.vertex : numberOf(extreme.vertex);
    }
  }
}

} // namespace smg
