// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/FormatTable.h"

#include <set>
#include <string>

namespace smg::testing
{

/** The suffixes for which `test(format, suffix)` holds, of all formats. */
template <class Test>
std::set<std::string> suffixesWhere(Test&& test)
{
  std::set<std::string> suffixes;
  for (const Format* format : formats())
  {
    for (const FileSuffix& suffix : format->suffixes)
    {
      if (test(*format, suffix))
      {
        suffixes.emplace(suffix.text);
      }
    }
  }
  return suffixes;
}

} // namespace smg::testing
