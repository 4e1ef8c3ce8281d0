// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/CoarsestSolver.h"

#include "Solver/Multigrid/Cycle/CoarsestFactor.h"

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
