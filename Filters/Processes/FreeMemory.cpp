// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/FreeMemory.h"

#include <fstream>
#include <limits>
#include <string>

namespace smg
{

std::int64_t freeMemory()
{
  std::ifstream file("/proc/meminfo");
  for (std::string key; file >> key; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
  {
    std::int64_t kibibytes = 0;
    if (key == "MemAvailable:" && file >> kibibytes)
    {
      return kibibytes << 10;
    }
  }
  return 0;
}

} // namespace smg
