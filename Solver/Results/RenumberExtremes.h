// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** Gives the vertices of a report's minima and maxima other numbers, numberOf(vertex). */
template <class NumberOf>
void renumberExtremes(Report& report, NumberOf numberOf)
{
  for (std::vector<Report::Extreme>* extremes : { &report.minimum, &report.maximum })
  {
    for (Report::Extreme& extreme : *extremes)
    {
      // Below 0: no value is a number.
      extreme.vertex = extreme.vertex < 0 ? extreme.vertex : numberOf(extreme.vertex);
    }
  }
}

} // namespace smg
