// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Deformation/RotationProblem.h"

#include "Solver/Jobs/Deformation/HandleChecks.h"

#include <algorithm>

namespace smg
{

void RotationProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const auto vertices = static_cast<std::size_t>(block.vertices());
  this->At.clear(vertices);
  this->Given.at(block, this->At);
  checkSize(this->At, block.vertices());
  for (std::size_t k = 0; k < vertices; ++k)
  {
    if (this->At.mask[k] == 0)
    {
      continue;
    }
    const std::int64_t i = block.firstVertex + static_cast<std::int64_t>(k);
    checkHeld(this->At, k, i);
    conditions.dirichlet[k] = 0;
    double* value = conditions.value.data() + Columns * k;
    std::copy_n(this->At.rotation.data() + 3 * k, 3, value);
    value[3] = this->At.logScale[k];
    if (this->TakeTarget)
    {
      this->TakeTarget(i, this->At.target.data() + 3 * k);
    }
    this->Shared += this->At.mask[k] > 1 ? 1 : 0;
  }
}

} // namespace smg
