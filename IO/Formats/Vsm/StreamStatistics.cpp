// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/StreamStatistics.h"

#include <algorithm>

namespace smg
{

StreamStatistics::StreamStatistics(const std::filesystem::path& scratch)
  : Changes(scratch, std::int64_t(1) << 20)
{
}

void StreamStatistics::count(std::int64_t cells, std::int64_t vertices)
{
  for (; this->Cells < cells; this->Cells++)
  {
    const std::uint8_t change = this->Changes.get(this->Cells);
    // A vertex ends after it begins: only vertices up to this cell can end at it.
    if (this->Vertices + change % FinalUnit > vertices)
    {
      break;
    }
    this->Vertices += change % FinalUnit;
    this->Alive += change % FinalUnit;
    this->Width = std::max(this->Width, this->Alive);
    this->Sum += static_cast<double>(this->Alive);
    this->Alive -= change / FinalUnit;
  }
  this->Changes.discardBelow(this->Cells);
}

StreamStatistics::Result StreamStatistics::result() const
{
  return { this->Width, this->Cells > 0 ? this->Sum / static_cast<double>(this->Cells) : 0 };
}

} // namespace smg
