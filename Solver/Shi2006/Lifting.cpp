// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/Lifting.h"

namespace smg::shi2006
{
namespace
{

bool hasLiftedNeighbour(const Level& level, std::int64_t i)
{
  const Edge* edge = level.edges.row(i);
  for (std::int64_t e = 0; e < level.edges.size(i) && edge[e].neighbour < i; ++e)
  {
    if (level.node[edge[e].neighbour].lifted())
    {
      return true;
    }
  }
  return false;
}

double pullOf(const Level& level, std::int64_t i)
{
  double sum = level.node[i].alpha;
  const Edge* edge = level.edges.row(i);
  for (std::int64_t e = 0; e < level.edges.size(i); ++e)
  {
    sum += level.node[edge[e].neighbour].lifted() ? edge[e].weight : 0.0;
  }
  return sum;
}

} // namespace

std::int64_t lift(Level& level)
{
  std::int64_t lifted = 0;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const bool isLifted = level.edges.size(i) > 0 && !hasLiftedNeighbour(level, i);
    level.node[i].parent = isLifted ? lifted++ : -1;
  }
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    level.node[i].pull = level.node[i].lifted() ? 0.0 : pullOf(level, i);
  }
  return lifted;
}

} // namespace smg::shi2006
