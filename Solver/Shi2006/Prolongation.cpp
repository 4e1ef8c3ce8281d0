// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/Prolongation.h"

#include <algorithm>
#include <functional>

namespace smg::shi2006
{
namespace
{

/**
 * With g_ij = d_ij - (v_i - v_j) and xi_i = xi0_i - alpha_i v_i, the value v_i + Delta_i of (5) is
 *
 *   (sum over lifted j of w_ij (v_j + Delta_j + d_ij) + xi0_i) / Z_i:
 *
 * the previous value cancels.
 */
void interpolate(Level& level, std::int64_t i)
{
  const int columns = level.columns();
  double* v = level.value.at(i);
  std::copy_n(level.constraint.at(i), columns, v);
  const Edge* edge = level.edges.row(i);
  const double* target = level.target.at(level.edges.start(i));
  for (std::int64_t e = 0; e < level.edges.size(i); ++e, target += columns)
  {
    const std::int64_t j = edge[e].neighbour;
    if (level.node[j].lifted())
    {
      const double* other = level.value.at(j);
      for (int k = 0; k < columns; ++k)
      {
        v[k] += edge[e].weight * (other[k] + target[k]);
      }
    }
  }
  for (int k = 0; k < columns; ++k)
  {
    v[k] /= level.node[i].pull;
  }
}

} // namespace

void prolong(const Level& coarse, Level& fine)
{
  const int columns = fine.columns();
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (fine.node[i].lifted())
    {
      const double* correction = coarse.value.at(fine.node[i].parent);
      double* v = fine.value.at(i);
      std::transform(v, v + columns, correction, v, std::plus<>());
    }
  }
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (!fine.node[i].lifted() && fine.node[i].pull > 0.0)
    {
      interpolate(fine, i);
    }
  }
}

} // namespace smg::shi2006
