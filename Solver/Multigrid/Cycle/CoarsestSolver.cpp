// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/CoarsestSolver.h"

#include "Solver/Multigrid/Cycle/CoarsestFactor.h"

#include <cfloat>
#include <cmath>

// Connects the blocks of the coarsest level with CoarsestFactor: reads the matrix from the packed
// rows and moves b and x, which are in single precision, to and from the columns of Eigen. The
// factor is hidden behind a pointer so that files which include the V-cycle do not include CHOLMOD.

namespace smg
{
namespace
{

/** The matrix of the level with its weights as they are stored, so rounded as the relaxation of
 * this level sees them. */
CoarsestMatrix matrixOf(LevelWindow<float>& level)
{
  CoarsestMatrix matrix;
  // The rounding of floats, in which sliver rows are stored: blocks in BFloat16 have no special
  // nodes (see packRows()).
  matrix.rounding = 2.0 * FLT_EPSILON;
  level.forRange(0, level.nodes(), level.up(),
    [&](const auto& a, const BlockPart<float>& part)
    {
      for (std::int64_t k = part.nodes.begin; k < part.nodes.end; ++k)
      {
        const std::int64_t i = part.header().first + k;
        // The row sum, recomputed from the diagonal: zero up to the rounding of this sum where no
        // constraint reaches, since the diagonal is the row sum plus the weights.
        const RowView row(part.header(), a, k);
        double sum = row.diagonal;
        double terms = row.diagonal;
        for (std::int64_t e = 0; e < row.size(); ++e)
        {
          const double weight = row.weight(e);
          sum -= weight;
          terms += std::fabs(weight);
          // The matrix is symmetric: one triangle suffices.
          if (row.delta(e) < 0)
          {
            matrix.lower.emplace_back(i, i + row.delta(e), -weight);
          }
        }
        matrix.diagonal.push_back(row.diagonal);
        // Row sums of a free component are exactly zero: what remains is the rounding of this sum,
        // relative to its terms. A sum that is not well above it would be wrong by a factor, with
        // which the V-cycles would not converge: the constant is then left to Components.
        constexpr double Least = 512.0 * DBL_EPSILON;
        matrix.anchored.push_back(std::fabs(sum) > Least * terms);
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
  this->solve(level, false);
}

void CoarsestSolver::solveSymmetric(LevelWindow<float>& level) const
{
  this->solve(level, true);
}

void CoarsestSolver::solve(LevelWindow<float>& level, bool isSymmetric) const
{
  const int stride = level.stride();
  Eigen::MatrixXd b(static_cast<Eigen::Index>(level.nodes()), stride);
  for (Eigen::Index i = 0; i < b.rows(); ++i)
  {
    const float* from = level.b().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      // With all lanes, the padded ones, too: these are zero and stay zero.
      b(i, lane) = from[lane];
    }
  }
  Eigen::MatrixXd x = this->Self->factor.solve(std::move(b));
  if (isSymmetric)
  {
    this->Self->factor.subtractMeans(x);
  }
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
