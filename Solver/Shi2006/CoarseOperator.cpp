// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/CoarseOperator.h"

#include <algorithm>
#include <vector>

namespace smg::shi2006
{
namespace
{

/** Sums the weights of one coarse row, with constant-time lookup of entries. */
class RowSum
{
public:
  RowSum(Pool& pool, std::int64_t coarseNodes)
    : Place(pool)
  {
    this->Place.extend(coarseNodes);
  }

  void begin() { this->Sums.clear(); }

  void add(std::int64_t neighbour, double weight)
  {
    auto& place = this->Place[neighbour];
    // An entry of an earlier row has another neighbour.
    if (place >= this->Sums.size() || this->Sums[place].neighbour != neighbour)
    {
      place = this->Sums.size();
      this->Sums.push_back({ neighbour, 0.0 });
    }
    this->Sums[place].weight += weight;
  }

  /** The edges by ascending neighbour, without those of zero weight: (8) divides by it. */
  const std::vector<Edge>& finish()
  {
    std::erase_if(this->Sums, [](const Edge& edge) { return !(edge.weight > 0.0); });
    std::sort(this->Sums.begin(), this->Sums.end(),
      [](const Edge& a, const Edge& b) { return a.neighbour < b.neighbour; });
    return this->Sums;
  }

private:
  Ring<std::size_t> Place;
  std::vector<Edge> Sums;
};

/**
 * Adds the contributions of the paths from i over its retained neighbours; returns the new alpha.
 */
double addPaths(const Level& fine, std::int64_t i, RowSum& row)
{
  double alpha = fine.node[i].alpha;
  const Edge* edge = fine.edges.row(i);
  for (std::int64_t e = 0; e < fine.edges.size(i); ++e)
  {
    const std::int64_t j = edge[e].neighbour;
    const Node& between = fine.node[j];
    if (!(between.pull > 0.0))
    {
      continue;
    }
    alpha += edge[e].weight * between.alpha / between.pull;
    const Edge* onward = fine.edges.row(j);
    for (std::int64_t h = 0; h < fine.edges.size(j); ++h)
    {
      const std::int64_t k = onward[h].neighbour;
      if (k != i && fine.node[k].lifted())
      {
        row.add(fine.node[k].parent, onward[h].weight * edge[e].weight / between.pull);
      }
    }
  }
  return alpha;
}

} // namespace

void buildCoarseOperator(const Level& fine, Level& coarse, Pool& pool)
{
  std::int64_t nodes = 0;
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    nodes += fine.node[i].lifted() ? 1 : 0;
  }
  RowSum row(pool, nodes);
  coarse.node.reserve(nodes);
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (!fine.node[i].lifted())
    {
      continue;
    }
    row.begin();
    const double alpha = addPaths(fine, i, row);
    const std::vector<Edge>& edges = row.finish();
    double diagonal = alpha;
    for (const Edge& edge : edges)
    {
      diagonal += edge.weight;
    }
    const auto size = static_cast<std::int64_t>(edges.size());
    std::copy(edges.begin(), edges.end(), coarse.edges.open(size));
    coarse.edges.close(size);
    const std::int64_t c = coarse.nodes();
    coarse.node.extendRaw(c + 1);
    coarse.node[c] = { alpha, diagonal };
  }
  coarse.target.extend(coarse.edges.start(nodes));
  coarse.constraint.extend(nodes);
  coarse.rightSide.extend(nodes);
  coarse.value.extend(nodes);
}

} // namespace smg::shi2006
