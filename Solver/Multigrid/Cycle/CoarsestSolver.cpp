// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/CoarsestSolver.h"

#include "Solver/Multigrid/Cycle/CoarsestFactor.h"

#include <cfloat>
#include <cmath>

namespace smg
{
namespace
{

CoarsestMatrix matrixOf(LevelWindow<float>& level)
{
  CoarsestMatrix matrix;
  matrix.rounding = 2.0 * FLT_EPSILON;
  level.forRange(0, level.nodes(), level.up(),
    [&](const auto& h, const auto& a, BlockRange range, float*, float*)
    {
      for (std::int64_t k = range.begin; k < range.end; ++k)
      {
        const std::int64_t i = h.first + k;
        double sum = a.diagonal[k];
        double terms = a.diagonal[k];
        const BlockRange row = entriesOf(h, a, k);
        for (std::int64_t e = row.begin; e < row.end; ++e)
        {
          const double weight = a.weight[e];
          sum -= weight;
          terms += std::fabs(weight);
          if (a.delta[e] < 0)
          {
            matrix.lower.emplace_back(i, i + a.delta[e], -weight);
          }
        }
        matrix.diagonal.push_back(a.diagonal[k]);
        // Row sums of a free component are exactly zero, up to the rounding of this sum.
        matrix.anchored.push_back(std::fabs(sum) > 8.0 * DBL_EPSILON * terms);
      }
    });
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
CoarsestSolver::CoarsestSolver(CoarsestSolver&& other) noexcept = default;
CoarsestSolver& CoarsestSolver::operator=(CoarsestSolver&& other) noexcept = default;

void CoarsestSolver::factorize(LevelWindow<float>& level)
{
  this->Self->factor.factorize(matrixOf(level), level.pool());
}

void CoarsestSolver::solve(LevelWindow<float>& level) const
{
  const int stride = level.stride();
  Eigen::MatrixXd b(static_cast<Eigen::Index>(level.nodes()), stride);
  for (Eigen::Index i = 0; i < b.rows(); ++i)
  {
    const float* from = level.b().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      b(i, lane) = from[lane];
    }
  }
  const Eigen::MatrixXd x = this->Self->factor.solve(std::move(b));
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    float* to = level.x().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      to[lane] = static_cast<float>(x(i, lane));
    }
  }
}

} // namespace smg
