// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/FixedEndsProblem.h"

namespace smg::benchmark
{

FixedEndsProblem::FixedEndsProblem(const StreamInfo& info)
  : Low(info.bounds[4] + 0.02 * (info.bounds[5] - info.bounds[4]))
  , High(info.bounds[5] - 0.02 * (info.bounds[5] - info.bounds[4]))
{
}

void FixedEndsProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  conditions.value = block.positions;
  for (std::int64_t v = 0; v < block.vertices(); ++v)
  {
    const double z = block.positions[3 * v + 2];
    conditions.dirichlet[v] = z <= this->Low || z >= this->High ? 0 : -1;
  }
}

} // namespace smg::benchmark
