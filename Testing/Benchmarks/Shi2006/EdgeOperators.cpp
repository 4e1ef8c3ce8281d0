// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/EdgeOperators.h"

#include <algorithm>
#include <functional>
#include <vector>

// The operators of the paper "Out-of-Core Multigrid Solver for Streaming Meshes" (after Shi et al.
// 2006) between two levels: lifting, prolongation (4) and (5), the coarse operator (7) and (9),
// relaxation (3), restriction (8) and (10). Names and signs follow the paper; Level.h has the
// equation (2) that all of them concern, EdgeOperators.h the formulas.
//
// Every operator is linear in the edges of a level, except that the coarse operator and the
// restriction visit the paths i - j - k over retained nodes j, whose number is the sum of the
// squares of the numbers of edges. Sums are taken node by node in stream order, so results have the
// same bits in every run.

namespace smg::shi2006
{
namespace
{

/** Whether a neighbour before node i is lifted. Those behind it are not decided yet. */
bool hasLiftedNeighbour(const Level& level, std::int64_t i)
{
  // Edges are in ascending order of their neighbours: the loop ends at the first one behind i.
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

/** Z_i, the denominator of (5): what ties a retained node to lifted nodes and to constraints. Edges
 * to other retained nodes are left out, as (5) leaves them out. */
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
  // In two passes: Z_i needs to know of all neighbours whether they are lifted, also of those
  // behind i.
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    // A node without edges would be lifted on every level and keep the coarsest one from becoming
    // small.
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
 * Equation (5) for a retained node. With g_ij = d_ij - (v_i - v_j) and xi_i = xi0_i - alpha_i v_i,
 * the value v_i + Delta_i is
 *
 *   (sum over lifted j of w_ij (v_j + Delta_j + d_ij) + xi0_i) / Z_i:
 *
 * the previous value v_i cancels. This is why the result of a V-cycle does not depend on the values
 * before it.
 */
void interpolate(Level& level, std::int64_t i)
{
  const int columns = level.columns();
  double* v = level.value.at(i);
  // The numerator begins with xi0_i and is summed in the place of the value.
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
    // (4): lifted nodes first, since (5) uses their corrected values.
    if (fine.node[i].lifted())
    {
      const double* correction = coarse.value.at(fine.node[i].parent);
      double* v = fine.value.at(i);
      std::transform(v, v + columns, correction, v, std::plus<>());
    }
  }
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    // Z_i = 0: nothing on the next level knows of this node, and relaxation alone changes it.
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

/** Sums the weights of one row of the coarse operator. Many paths lead to the same neighbour; its
 * entry is found in constant time by a table over all coarse nodes, which is not cleared between
 * rows. */
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
    // The table may still hold the place of an earlier row. It is valid only if the entry there is
    // of this neighbour.
    if (place >= this->Sums.size() || this->Sums[place].neighbour != neighbour)
    {
      place = this->Sums.size();
      this->Sums.push_back({ neighbour, 0.0 });
    }
    this->Sums[place].weight += weight;
  }

  /** The edges of the row by ascending neighbour, without those of weight zero, since (8) divides
   * by the weight. */
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

/** Adds the paths from lifted i over its retained neighbours j to `row`: the weights of (7).
 * Returns the alpha of the coarse node by (9): what j is tied to beside lifted nodes is shared
 * among these. */
double addPaths(const Level& fine, std::int64_t i, RowSum& row)
{
  double alpha = fine.node[i].alpha;
  const Edge* edge = fine.edges.row(i);
  for (std::int64_t e = 0; e < fine.edges.size(i); ++e)
  {
    const std::int64_t j = edge[e].neighbour;
    const Node& between = fine.node[j];
    // Lifted neighbours, which lifting excludes, and nodes that nothing pulls end no path.
    if (!(between.pull > 0.0))
    {
      continue;
    }
    alpha += edge[e].weight * between.alpha / between.pull;
    const Edge* onward = fine.edges.row(j);
    for (std::int64_t h = 0; h < fine.edges.size(j); ++h)
    {
      const std::int64_t k = onward[h].neighbour;
      // The path back to i would be an edge of the coarse node to itself.
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
  // Coarse nodes are numbered in the order of their fine nodes, which is the order of the loop
  // below.
  std::int64_t nodes = 0;
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    nodes += fine.node[i].lifted() ? 1 : 0;
  }
  // One table for all rows: of the size of the coarse level, and accounted for.
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
    // The diagonal is summed from what is stored, so that row sums are exactly alpha.
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

/** sum = b_i + sum_j w_ij v_j, the numerator of (3). `sum` may be v_i itself, since a node has no
 * edge to itself. */
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

/** Gauss-Seidel: node i sees the values of this sweep before it, and the values of the last sweep
 * behind it. */
void relax(Level& level)
{
  const int columns = level.columns();
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const double diagonal = level.node[i].diagonal;
    // Without edges and alpha the equation is 0 = 0.
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

/** Restriction to one coarse node after another: first the sums over paths, (8) and (10), which use
 * g and xi of the current values, then the division of (8) by the weights of the coarse edges. */
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
    // The remainder of node i itself; its retained neighbours add their terms of (10) below.
    this->setXi(i, this->Coarse.constraint.at(c));
    const Edge* edge = this->Fine.edges.row(i);
    for (std::int64_t e = 0; e < this->Fine.edges.size(i); ++e)
    {
      const Node& between = this->Fine.node[edge[e].neighbour];
      // The same paths as in buildCoarseOperator(): other ones would restrict to edges that do not
      // exist.
      if (between.pull > 0.0)
      {
        this->setG(i, e);
        this->passXi(edge[e], this->Coarse.constraint.at(c));
        this->passG(i, edge[e]);
      }
    }
    // Sums of w g over the paths become g itself, an average with the weights w_kj w_ji / Z_j.
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
  /** g of edge `e` of row i, in column k: how far the current values are from the target of the
   * edge. */
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

  /** A term of (10): the remainder of retained j at the end of the edge, and what alpha_j makes of
   * the g of the edge to it. */
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

  /** The terms of (8) with the paths from i over retained j at the end of the edge. Along a path
   * the g of both edges add up. */
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

  /** The place where the g of a coarse edge is summed; null if the edge was left out since its
   * weight is zero. */
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
  // The unknowns of the next level are corrections, so they start from zero.
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
  // What relaxation needs of the new targets and constraints.
  sumRightSide(coarse);
}

/** b is summed once before the sweeps of a level, instead of in each of them. */
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
