// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/Relaxation.h"

#include <algorithm>
#include <vector>

namespace smg::shi2006
{
namespace
{

/** sum = b_i + sum_j w_ij v_j, the numerator of (3); `sum` may be v_i itself. */
void addNeighbours(const Level& level, std::int64_t i, double* sum)
{
  const int columns = level.columns();
  std::copy_n(level.rightSide.at(i), columns, sum);
  const Edge* edge = level.edges.row(i);
  const std::int64_t size = level.edges.size(i);
  const double* values = level.value.at(0);
  for (std::int64_t e = 0; e < size; ++e)
  {
    const double* other = values + columns * edge[e].neighbour;
    for (int k = 0; k < columns; ++k)
    {
      sum[k] += edge[e].weight * other[k];
    }
  }
}

} // namespace

void relax(Level& level)
{
  const int columns = level.columns();
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const double diagonal = level.node[i].diagonal;
    if (diagonal > 0.0)
    {
      double* v = level.value.at(i);
      addNeighbours(level, i, v);
      for (int k = 0; k < columns; ++k)
      {
        v[k] /= diagonal;
      }
    }
  }
}

double residualSquares(const Level& level)
{
  std::vector<double> sum(static_cast<std::size_t>(level.columns()));
  double squares = 0.0;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    addNeighbours(level, i, sum.data());
    for (int k = 0; k < level.columns(); ++k)
    {
      const double residual =
        sum[static_cast<std::size_t>(k)] - level.node[i].diagonal * level.value.at(i)[k];
      squares += residual * residual;
    }
  }
  return squares;
}

} // namespace smg::shi2006
