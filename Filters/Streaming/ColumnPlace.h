// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

#include <string_view>
#include <vector>

namespace smg
{

/** The place of the column `name` among the specs; -1 if there is none. */
inline int placeOfColumn(const std::vector<ColumnSpec>& specs, std::string_view name)
{
  for (std::size_t i = 0; i < specs.size(); ++i)
  {
    if (specs[i].name == name)
    {
      return static_cast<int>(i);
    }
  }
  return -1;
}

} // namespace smg
