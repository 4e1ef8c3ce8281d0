// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/CoarsestSolver.h"

#include "Solver/Core/Error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cmath>
#include <vector>

namespace smg
{
namespace
{

using Matrix = Eigen::SparseMatrix<double>;

/** Rows of the level as triplets, and the row sums. */
struct Assembled
{
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<double> diagonal, rowSum;
};

Assembled assemble(LevelWindow<float>& level)
{
  Assembled result;
  const auto nodes = static_cast<std::size_t>(level.nodes());
  result.diagonal.resize(nodes);
  result.rowSum.resize(nodes);
  level.forRange(0, level.nodes(),
    [&](const auto& h, const auto& a, BlockRange range, float*, float*)
    {
      for (std::int64_t k = range.begin; k < range.end; ++k)
      {
        const std::int64_t i = h.first + k;
        double sum = a.diagonal[k];
        const BlockRange row = entriesOf(h, a, k);
        for (std::int64_t e = row.begin; e < row.end; ++e)
        {
          sum -= a.weight[e];
          result.triplets.emplace_back(i, i + a.delta[e], -static_cast<double>(a.weight[e]));
        }
        result.diagonal[static_cast<std::size_t>(i)] = a.diagonal[k];
        result.rowSum[static_cast<std::size_t>(i)] = sum;
      }
    });
  return result;
}

/** Marks one node of each component whose row sums are all nought. */
std::vector<bool> pinnedNodes(const Assembled& rows)
{
  const std::size_t nodes = rows.diagonal.size();
  std::vector<int> component(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    component[i] = static_cast<int>(i);
  }
  const auto root = [&](int i)
  {
    while (component[static_cast<std::size_t>(i)] != i)
    {
      i = component[static_cast<std::size_t>(i)] =
        component[static_cast<std::size_t>(component[static_cast<std::size_t>(i)])];
    }
    return i;
  };
  for (const auto& t : rows.triplets)
  {
    const int a = root(static_cast<int>(t.row()));
    const int b = root(static_cast<int>(t.col()));
    component[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<bool> pinned(nodes);
  std::vector<bool> anchored(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    // Row sums of a free component are exact zeros up to the rounding of this very sum.
    if (std::fabs(rows.rowSum[i]) > 1e-12 * rows.diagonal[i])
    {
      anchored[static_cast<std::size_t>(root(static_cast<int>(i)))] = true;
    }
  }
  for (std::size_t i = 0; i < nodes; ++i)
  {
    pinned[i] = root(static_cast<int>(i)) == static_cast<int>(i) && !anchored[i];
  }
  return pinned;
}

} // namespace

struct CoarsestSolver::Implementation
{
  Eigen::CholmodSimplicialLDLT<Matrix, Eigen::Lower> factor;
  std::vector<bool> pinned;
};

CoarsestSolver::CoarsestSolver()
  : Self(std::make_unique<Implementation>())
{
}

CoarsestSolver::~CoarsestSolver() = default;

void CoarsestSolver::factorize(LevelWindow<float>& level)
{
  if (level.nodes() == 0)
  {
    return;
  }
  const Assembled rows = assemble(level);
  this->Self->pinned = pinnedNodes(rows);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(rows.triplets.size() + rows.diagonal.size());
  for (const auto& t : rows.triplets)
  {
    const bool pinned = this->Self->pinned[static_cast<std::size_t>(t.row())] ||
                        this->Self->pinned[static_cast<std::size_t>(t.col())];
    if (t.row() > t.col() && !pinned)
    {
      triplets.push_back(t);
    }
  }
  for (std::size_t i = 0; i < rows.diagonal.size(); ++i)
  {
    triplets.emplace_back(i, i, this->Self->pinned[i] ? 1.0 : rows.diagonal[i]);
  }
  Matrix matrix(level.nodes(), level.nodes());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  this->Self->factor.compute(matrix);
  if (this->Self->factor.info() != Eigen::Success)
  {
    throw Error(
      "the coarsest level's matrix could not be factorised: the weights of the mesh span too "
      "many orders of magnitude; use uniform weights");
  }
}

void CoarsestSolver::solve(LevelWindow<float>& level) const
{
  const int stride = level.stride();
  const auto nodes = static_cast<Eigen::Index>(level.nodes());
  if (nodes == 0)
  {
    return;
  }
  Eigen::MatrixXd b(nodes, stride);
  for (Eigen::Index i = 0; i < nodes; ++i)
  {
    const float* from = level.b().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      b(i, lane) = this->Self->pinned[static_cast<std::size_t>(i)] ? 0.0 : from[lane];
    }
  }
  const Eigen::MatrixXd x = this->Self->factor.solve(b);
  for (Eigen::Index i = 0; i < nodes; ++i)
  {
    float* to = level.x().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      to[lane] = static_cast<float>(x(i, lane));
    }
  }
}

} // namespace smg
