// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/StreamStatistics.h"

#include <algorithm>

namespace smg
{

StreamStatistics::StreamStatistics(const std::filesystem::path& scratch)
  : Changes(scratch, std::int64_t(1) << 20)
{
}

StreamStatistics::Result StreamStatistics::count(std::int64_t cells)
{
  Result result;
  std::int64_t alive = 0;
  double sum = 0;
  for (std::int64_t cell = 0; cell < cells; cell++)
  {
    const std::uint8_t change = this->Changes.get(cell);
    alive += change % FinalUnit;
    result.width = std::max(result.width, alive);
    sum += static_cast<double>(alive);
    alive -= change / FinalUnit;
  }
  result.mean = cells > 0 ? sum / static_cast<double>(cells) : 0;
  return result;
}

} // namespace smg
