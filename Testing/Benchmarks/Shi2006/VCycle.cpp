// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/VCycle.h"

#include "Solver/Multigrid/Cycle/CoarsestFactor.h"
#include "Testing/Benchmarks/Shi2006/EdgeOperators.h"

// The hierarchy of the paper and its V-cycle, level by level in memory. The coarsest level is
// solved directly. A V-cycle costs the sweeps of all levels; each level has fewer nodes than the
// one before, but more edges per node, since the coarse operator connects what is two edges apart.

namespace smg::shi2006
{
namespace
{

/** The matrix of a level as CHOLMOD gets it: entries below the diagonal and the diagonal. A node
 * with alpha anchors its part; parts without are pinned by CoarsestFactor. */
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
  // All vertices may be constrained; there is no factor then.
  if (level.nodes() == 0)
  {
    return;
  }
  // The columns of a node are contiguous, so a level is a matrix with a row for each node.
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
  // A level that has lost hardly any nodes will not become smaller: most of its nodes have no edges
  // between them. The direct solver then takes it as it is.
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

/** Parts without alpha on the coarsest level, and nodes without edges and alpha on the levels
 * between, which are retained there and so have no node on the next level. */
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
  // The recursion ends with the direct solve.
  if (l + 1 == this->levels())
  {
    this->Coarsest.solve(fine);
    return;
  }
  Level& coarse = this->at(l + 1);
  // The equation of the next level is made from the remainders of this one, so it comes after the
  // sweeps; the sweeps after the correction smooth what the interpolation has left.
  this->relaxLevel(l, stepDone, 0.0);
  restrictRightSide(fine, coarse);
  this->run(l + 1, stepDone);
  prolong(coarse, fine);
  this->relaxLevel(l, stepDone, 0.5);
}

/** The sweeps before or after the correction. On the finest level they report progress. */
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
