// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/FixedEndsProblem.h"

#include <algorithm>

namespace smg::benchmark
{

FixedEndsProblem::FixedEndsProblem(const StreamInfo& info, Start start)
  : Low(info.bounds[4] + 0.02 * (info.bounds[5] - info.bounds[4]))
  , High(info.bounds[5] - 0.02 * (info.bounds[5] - info.bounds[4]))
  , From(start)
{
}

void FixedEndsProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  conditions.value = block.positions;
  for (std::int64_t v = 0; v < block.vertices(); ++v)
  {
    const double z = block.positions[3 * v + 2];
    const bool isHeld = z <= this->Low || z >= this->High;
    conditions.dirichlet[v] = isHeld ? 0 : -1;
    if (!isHeld && this->From == Start::Zero)
    {
      std::fill_n(conditions.value.begin() + 3 * v, 3, 0.0);
    }
  }
}

} // namespace smg::benchmark
