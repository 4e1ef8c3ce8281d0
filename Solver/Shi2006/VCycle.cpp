// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/VCycle.h"

#include "Solver/Shi2006/CoarseOperator.h"
#include "Solver/Shi2006/Lifting.h"
#include "Solver/Shi2006/Prolongation.h"
#include "Solver/Shi2006/Relaxation.h"
#include "Solver/Shi2006/RightSideTransfer.h"

namespace smg::shi2006
{

VCycle::VCycle(Pool& pool, Level& finest, int sweeps, std::int64_t coarsestNodes)
  : Finest(finest)
  , Sweeps(sweeps)
{
  constexpr double StalledShare = 0.8;
  double share = 0.0;
  do
  {
    Level& fine = this->at(this->Coarse.size());
    lift(fine);
    this->Coarse.push_back(std::make_unique<Level>(pool, fine.columns()));
    buildCoarseOperator(fine, *this->Coarse.back(), pool);
    share = static_cast<double>(this->Coarse.back()->nodes()) / static_cast<double>(fine.nodes());
  } while (this->Coarse.back()->nodes() > coarsestNodes && share <= StalledShare);
  this->Coarsest.factorize(*this->Coarse.back(), pool);
}

std::int64_t VCycle::detachedParts() const
{
  std::int64_t parts = this->Coarsest.floatingParts();
  for (std::size_t l = 1; l + 1 < this->levels(); ++l)
  {
    const Level& level = this->level(l);
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      parts += level.node[i].diagonal > 0.0 ? 0 : 1;
    }
  }
  return parts;
}

void VCycle::run(std::size_t l, const StepDone& stepDone)
{
  Level& fine = this->at(l);
  if (l + 1 == this->levels())
  {
    this->Coarsest.solve(fine);
    return;
  }
  Level& coarse = this->at(l + 1);
  this->relaxLevel(l, stepDone, 0.0);
  restrictRightSide(fine, coarse);
  this->run(l + 1, stepDone);
  prolong(coarse, fine);
  this->relaxLevel(l, stepDone, 0.5);
}

/** The sweeps before or after the correction; those of the finest level report progress. */
void VCycle::relaxLevel(std::size_t l, const StepDone& stepDone, double begin)
{
  for (int sweep = 1; sweep <= this->Sweeps; ++sweep)
  {
    relax(this->at(l));
    if (l == 0)
    {
      stepDone(begin + 0.5 * sweep / this->Sweeps);
    }
  }
}

} // namespace smg::shi2006
