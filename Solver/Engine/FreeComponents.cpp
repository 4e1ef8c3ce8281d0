// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Engine/FreeComponents.h"

namespace smg
{
void FreeComponents::shift(std::int64_t first, std::int64_t count, std::span<double> values)
{
  for (std::int64_t i = 0; !this->MeanShifts.empty() && i < count; ++i)
  {
    const std::int64_t vertex = first + i;
    const std::int64_t root =
      this->rootOf(this->Labels.block(vertex / Block)[static_cast<std::size_t>(vertex % Block)]);
    for (int k = 0; root >= 0 && k < this->Columns; ++k)
    {
      values[static_cast<std::size_t>(i * this->Columns + k)] -=
        this->MeanShifts[static_cast<std::size_t>(root * this->Columns + k)];
    }
  }
}

} // namespace smg
