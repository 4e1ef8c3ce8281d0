// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/RightSideTransfer.h"

#include <algorithm>
#include <vector>

namespace smg::shi2006
{
namespace
{

/** Restricts to the coarse nodes one by one. */
class Restriction
{
public:
  Restriction(const Level& fine, Level& coarse)
    : Fine(fine)
    , Coarse(coarse)
    , Columns(fine.columns())
    , G(static_cast<std::size_t>(fine.columns()))
  {
  }

  void operator()(std::int64_t i)
  {
    const std::int64_t c = this->Fine.node[i].parent;
    this->setXi(i, this->Coarse.constraint.at(c));
    const Edge* edge = this->Fine.edges.row(i);
    for (std::int64_t e = 0; e < this->Fine.edges.size(i); ++e)
    {
      const Node& between = this->Fine.node[edge[e].neighbour];
      if (between.pull > 0.0)
      {
        this->setG(i, e);
        this->passXi(edge[e], this->Coarse.constraint.at(c));
        this->passG(i, edge[e]);
      }
    }
    const std::int64_t begin = this->Coarse.edges.start(c);
    const Edge* out = this->Coarse.edges.row(c);
    for (std::int64_t e = 0; e < this->Coarse.edges.size(c); ++e)
    {
      for (int k = 0; k < this->Columns; ++k)
      {
        this->Coarse.target.at(begin + e)[k] /= out[e].weight;
      }
    }
  }

private:
  /** g of edge `e` of row i, column k. */
  double g(std::int64_t i, std::int64_t e, int k) const
  {
    const std::int64_t j = this->Fine.edges.row(i)[e].neighbour;
    return this->Fine.target.at(this->Fine.edges.start(i) + e)[k] -
           (this->Fine.value.at(i)[k] - this->Fine.value.at(j)[k]);
  }

  /** xi_i, column k. */
  double xi(std::int64_t i, int k) const
  {
    return this->Fine.constraint.at(i)[k] - this->Fine.node[i].alpha * this->Fine.value.at(i)[k];
  }

  void setXi(std::int64_t i, double* xi) const
  {
    for (int k = 0; k < this->Columns; ++k)
    {
      xi[k] = this->xi(i, k);
    }
  }

  void setG(std::int64_t i, std::int64_t e)
  {
    for (int k = 0; k < this->Columns; ++k)
    {
      this->G[static_cast<std::size_t>(k)] = this->g(i, e, k);
    }
  }

  /** A term of (10): the contribution of retained j at the end of the edge. */
  void passXi(const Edge& edge, double* xi) const
  {
    const std::int64_t j = edge.neighbour;
    const Node& between = this->Fine.node[j];
    for (int k = 0; k < this->Columns; ++k)
    {
      const double g = this->G[static_cast<std::size_t>(k)];
      xi[k] += edge.weight * (this->xi(j, k) + between.alpha * g) / between.pull;
    }
  }

  /** The terms of (8) with a path from i over retained j at the end of the edge. */
  void passG(std::int64_t i, const Edge& edge)
  {
    const std::int64_t j = edge.neighbour;
    const Edge* onward = this->Fine.edges.row(j);
    for (std::int64_t h = 0; h < this->Fine.edges.size(j); ++h)
    {
      const Node& end = this->Fine.node[onward[h].neighbour];
      double* sum = onward[h].neighbour != i && end.lifted()
                      ? this->sumOf(this->Fine.node[i].parent, end.parent)
                      : nullptr;
      const double weight = onward[h].weight * edge.weight / this->Fine.node[j].pull;
      for (int k = 0; sum && k < this->Columns; ++k)
      {
        sum[k] += weight * (this->g(j, h, k) + this->G[static_cast<std::size_t>(k)]);
      }
    }
  }

  /** The accumulator for g of the coarse edge; null if its weight is zero. */
  double* sumOf(std::int64_t from, std::int64_t to) const
  {
    const Edge* begin = this->Coarse.edges.row(from);
    const Edge* end = begin + this->Coarse.edges.size(from);
    const Edge* edge = std::lower_bound(begin, end, to,
      [](const Edge& a, std::int64_t neighbour) { return a.neighbour < neighbour; });
    return edge != end && edge->neighbour == to
             ? this->Coarse.target.at(this->Coarse.edges.start(from) + (edge - begin))
             : nullptr;
  }

  const Level& Fine;
  Level& Coarse;
  int Columns;
  std::vector<double> G; // g_ji of the edge from i to the retained node on the path
};

} // namespace

void restrictRightSide(const Level& fine, Level& coarse)
{
  std::ranges::fill(coarse.target.range(0, coarse.target.end()), 0.0);
  std::ranges::fill(coarse.value.range(0, coarse.nodes()), 0.0);
  Restriction restrictTo(fine, coarse);
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (fine.node[i].lifted())
    {
      restrictTo(i);
    }
  }
  sumRightSide(coarse);
}

void sumRightSide(Level& level)
{
  const int columns = level.columns();
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    double* b = level.rightSide.at(i);
    std::copy_n(level.constraint.at(i), columns, b);
    const Edge* edge = level.edges.row(i);
    const double* target = level.target.at(level.edges.start(i));
    for (std::int64_t e = 0; e < level.edges.size(i); ++e, target += columns)
    {
      for (int k = 0; k < columns; ++k)
      {
        b[k] += edge[e].weight * target[k];
      }
    }
  }
}

} // namespace smg::shi2006
