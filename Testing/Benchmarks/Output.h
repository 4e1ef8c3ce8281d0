// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <string>

namespace smg::benchmark
{

/** Formats a number like printf. */
inline std::string text(const char* format, double value)
{
  char characters[64];
  std::snprintf(characters, sizeof(characters), format, value);
  return characters;
}

/** Writes the numbers of a benchmark to a file; an empty name writes nothing. Throws Error. */
inline void writeNumbers(const std::string& file, const nlohmann::json& numbers)
{
  if (!file.empty() && !(std::ofstream(file) << numbers.dump(2) << '\n'))
  {
    throw Error(file + ": cannot be written.");
  }
}

} // namespace smg::benchmark
