// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/EdgeOperators.h"

#include <algorithm>
#include <functional>
#include <vector>

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
