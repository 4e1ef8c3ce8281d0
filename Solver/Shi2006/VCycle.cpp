// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/VCycle.h"

#include "Solver/Multigrid/Cycle/CoarsestFactor.h"
#include "Solver/Shi2006/EdgeOperators.h"

namespace smg::shi2006
{
namespace
{

CoarsestMatrix matrixOf(const Level& level)
{
  CoarsestMatrix matrix;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const Edge* edge = level.edges.row(i);
    for (std::int64_t e = 0; e < level.edges.size(i) && edge[e].neighbour < i; ++e)
    {
      matrix.lower.emplace_back(i, edge[e].neighbour, -edge[e].weight);
    }
    matrix.diagonal.push_back(level.node[i].diagonal);
    matrix.anchored.push_back(level.node[i].alpha > 0.0);
  }
  return matrix;
}

} // namespace

struct CoarsestSolver::Implementation
{
  CoarsestFactor factor;
};

CoarsestSolver::CoarsestSolver()
  : Self(std::make_unique<Implementation>())
{
}

CoarsestSolver::~CoarsestSolver() = default;

void CoarsestSolver::factorize(const Level& level, Pool& pool)
{
  this->Self->factor.factorize(matrixOf(level), pool);
}

std::int64_t CoarsestSolver::floatingParts() const
{
  return this->Self->factor.floatingComponents();
}

void CoarsestSolver::solve(Level& level) const
{
  if (level.nodes() == 0)
  {
    return;
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto matrixAt = [&](Ring<double>& values)
  { return Eigen::Map<RowMajor>(values.at(0), level.nodes(), level.columns()); };
  matrixAt(level.value) = this->Self->factor.solve(matrixAt(level.rightSide));
}

} // namespace smg::shi2006

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
