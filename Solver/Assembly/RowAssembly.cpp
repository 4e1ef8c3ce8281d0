// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/RowAssembly.h"

#include "Solver/Assembly/RowSums.h"
#include "Solver/Core/SimdPack.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

// The rows of the finest level. The equation of an unknown i is
//
// (rowSum + sum_j w_ij) u_i - sum_j w_ij u_j = b_i,
//
// with the sums over its unknown neighbours. A prescribed neighbour contributes w_ij to rowSum and
// w_ij times its value to b, so that a row without such neighbours, screening or Robin conditions
// has the row sum 0.
//
// Entries have single precision, and the diagonal is the sum of the entries as they are stored:
// rounding changes the weights, but not the row sum. That is not good enough where large weights of
// slivers cancel; such rows keep weights in double precision beside the entries (addEdge(),
// sharpen()). The same sums give the initial residual, by which the convergence is measured.
//
// Rows are collected in ascending order from edges in ascending order, so that their bits depend on
// neither blocks nor threads. The time is linear in the number of edges.

namespace smg
{

namespace
{

/** The distance from vertex i to its neighbour j. Throws Error if a row cannot represent it. */
std::int32_t distance(std::int64_t i, std::int64_t j)
{
  const std::int64_t delta = j - i;
  if (delta > RowEntry::MaxDistance || delta < -RowEntry::MaxDistance)
  {
    throw Error("vertices " + std::to_string(i) + " and " + std::to_string(j) +
                " share an edge but lie too far apart in the stream: convert the mesh with the "
                "order bfs");
  }
  return static_cast<std::int32_t>(delta);
}

} // namespace

RowAssembly::RowAssembly(CellType type, const OpenVertices& vertices, Problem& problem,
  AssembledRows& rows, Components& components, SliverRows stiff, RowListener* listener)
  : Vertices(vertices)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Type(type)
  , Kind(problem.weights())
  , Out(rows)
  , Parts(components)
  , Stiff(stiff)
  , Listener(listener)
  , Zeros(this->Columns)
  , B(this->Columns)
  , Constraint(this->Columns)
  , Residual(problem.columns())
{
}

/** Appends row, right-hand side and initial value of a vertex. The initial value comes first, since
 * a vertex that is not an unknown has one, too. */
void RowAssembly::close(const FinalVertices& collected, std::size_t k)
{
  const std::int64_t i = collected.first + static_cast<std::int64_t>(k);
  const FinalVertices::Vertex& vertex = collected.vertices[k];
  const std::size_t begin = collected.begin(k);
  const double* x = this->initial(i);
  this->Out.x.insert(this->Out.x.end(), x, x + this->Columns);
  if (this->Out.placed)
  {
    this->place(i);
  }
  if (isKnown(this->Vertices.dirichlet[i], vertex.end - begin, vertex.rowSum))
  {
    this->closeKnown(i);
    return;
  }
  const double* load = collected.loads.data() + k * this->Columns;
  std::copy_n(load, this->Columns, this->B.data());
  std::copy_n(load, this->Columns, this->Constraint.data());
  this->RowSum = vertex.rowSum;
  this->Scale = static_cast<double>(vertex.scale);
  this->addNeighbours(i, std::span(collected.neighbours).subspan(begin, vertex.end - begin),
    collected.targets.empty() ? nullptr : collected.targets.data() + begin * this->Columns);
  // Before the row is closed, since it changes the row sum and b; count() takes back what is not
  // part of the problem.
  this->regularise(i);
  this->Out.rows.close(this->Size, this->RowSum, -1, this->Stiff(this->Least),
    this->AnyPrecise ? this->weights() : std::span<const double>());
  this->Out.b.insert(this->Out.b.end(), this->B.begin(), this->B.end());
  if (this->Listener)
  {
    this->Listener->constraint(this->Constraint.data());
  }
  this->count(
    i, vertex, collected.jumps.empty() ? nullptr : collected.jumps.data() + k * this->Columns);
}

/** Appends the position of a vertex. */
void RowAssembly::place(std::int64_t i)
{
  const double* point = this->Vertices.points.at(i);
  if (i == 0)
  {
    std::copy_n(point, 3, this->Origin.begin());
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Out.points.push_back(static_cast<float>(point[k] - this->Origin[k]));
  }
}

/** Completes a vertex that is not an unknown: prescribed, or fixed at its initial value. Its row is
 * 1 * u_i = x_i, without entries, so that it is a node like others and needs no numbering of its
 * own. */
void RowAssembly::closeKnown(std::int64_t i)
{
  const double* x = this->initial(i);
  // A tied vertex gets its value from another one in the end.
  if (!this->Vertices.ties.isTied(i))
  {
    ++(this->Vertices.dirichlet[i] >= 0 ? this->Prescribed : this->Held);
  }
  this->Out.b.insert(this->Out.b.end(), x, x + this->Columns);
  if (this->Listener)
  {
    this->Listener->constraint(x);
  }
  this->Out.rows.open(0);
  this->Out.rows.close(0, 1.0, -1);
}

/**
 * Adds an edge to the sums of the row and returns whether it belongs to slivers, that is, whether
 * its weight exceeds the largest one of regular cells. The weights of slivers are large and partly
 * cancel; rounding them to single precision would affect the solution, since the error is of the
 * size of the weights of other cells. The answer depends on the edge alone, so that both of its
 * rows agree.
 */
inline bool RowAssembly::addEdge(std::int64_t i, const RowNeighbour& neighbour, double weight)
{
  const double magnitude = std::fabs(weight);
  this->Edges += magnitude;
  if (this->Kind != Weights::Cotangent)
  {
    this->Ordinary += magnitude;
    return false;
  }
  const double bound = squaredRegularWeight(
    this->Type, this->Vertices.points.at(i), this->Vertices.points.at(neighbour.to));
  // Squares are compared, and with the smaller scale: nearly all edges are ordinary by either
  // scale, and return without a square root.
  const double least = std::min(this->Scale, this->Out.weightScale);
  if (magnitude * magnitude <= bound * least * least)
  {
    this->Ordinary += magnitude;
    return false;
  }
  const double regular = std::sqrt(bound);
  // The residual is judged by the scale at this vertex; the precision by the scale of the whole
  // problem, which both rows share.
  this->Ordinary += std::min(magnitude, regular * this->Scale);
  return std::fabs(neighbour.weight) > regular * this->Out.weightScale;
}

/** Adds an entry for a neighbour that is not prescribed. */
inline void RowAssembly::addUnknown(
  std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target)
{
  const auto stored = static_cast<float>(neighbour.weight);
  const bool precise = this->addEdge(i, neighbour, static_cast<double>(stored));
  // The diagonal is the sum of the weights as they are stored.
  const double weight = precise ? neighbour.weight : static_cast<double>(stored);
  this->Row[this->Size] = { delta, stored };
  this->Weight[static_cast<std::size_t>(this->Size++)] = weight;
  this->Least = std::min(this->Least, stored);
  this->AnyPrecise = this->AnyPrecise || precise;
  if (target)
  {
    this->addTarget(weight, target);
  }
}

/** What a solution leaves of the right-hand side: the flow along each edge, by differences. Their
 * rounding is relative to what flows, not to weights times values. */
void RowAssembly::addFlow(double weight, std::int64_t i, std::int64_t neighbour)
{
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->B[k] += weight * this->Vertices.difference(neighbour, i, k);
  }
}

/** Makes the entries of the row, and adds the contributions of prescribed neighbours and of edge
 * targets to b. */
void RowAssembly::addNeighbours(
  std::int64_t i, std::span<const RowNeighbour> neighbours, const double* target)
{
  // Room for all neighbours; close() gives back what prescribed ones do not need.
  this->Row = this->Out.rows.open(static_cast<std::int64_t>(neighbours.size()));
  this->Weight.resize(std::max(this->Weight.size(), neighbours.size()));
  this->Size = 0;
  this->Edges = this->Ordinary = 0.0;
  this->Least = 0.0F;
  this->AnyPrecise = false;
  // Addressed by the distance from vertex i, see Ring.
  const std::int32_t* dirichlet = this->Vertices.dirichlet.at(i);
  for (const RowNeighbour& neighbour : neighbours)
  {
    const std::int32_t delta = distance(i, neighbour.to);
    if (dirichlet[delta] >= 0)
    {
      this->addKnown(i, delta, neighbour, target);
    }
    else
    {
      this->addUnknown(i, delta, neighbour, target);
    }
    target = target ? target + this->Columns : nullptr;
  }
  this->sharpen(neighbours);
  if (this->Vertices.isSolved())
  {
    this->addFlows(i, neighbours);
  }
}

/** Adds the flow along each entry, by the weights as the row has them in the end. */
void RowAssembly::addFlows(std::int64_t i, std::span<const RowNeighbour> neighbours)
{
  std::size_t e = 0;
  for (const RowNeighbour& neighbour : neighbours)
  {
    if (this->Vertices.dirichlet[neighbour.to] < 0)
    {
      this->addFlow(this->Weight[e++], i, neighbour.to);
    }
  }
}

/** If the weights of a row nearly cancel, keeps all of them in double precision, so that the small
 * diagonal is that of the problem. The far corner of a needle has such a row. The rows of its
 * neighbours may have these weights in single precision, which is enough for their diagonals. */
void RowAssembly::sharpen(std::span<const RowNeighbour> neighbours)
{
  if (this->Kind != Weights::Cotangent)
  {
    return;
  }
  // Down to a hundredth of its terms, a sum of numbers rounded to 6e-8 still has five digits.
  constexpr double Cancelling = 1e-2;
  double diagonal = this->RowSum, terms = 0.0;
  for (const double weight : this->weights())
  {
    diagonal += weight;
    terms += std::fabs(weight);
  }
  if (diagonal >= Cancelling * terms)
  {
    return;
  }
  std::size_t e = 0;
  for (const RowNeighbour& neighbour : neighbours)
  {
    // Entries are the neighbours that are not prescribed, in this order.
    if (this->Vertices.dirichlet[neighbour.to] < 0)
    {
      this->Weight[e++] = neighbour.weight;
    }
  }
  this->AnyPrecise = this->Size > 0;
}

/** Adds the edge to a prescribed neighbour to rowSum and b; it has no entry. */
void RowAssembly::addKnown(
  std::int64_t i, std::int32_t delta, const RowNeighbour& neighbour, const double* target)
{
  const double weight = knownWeight(this->Kind, neighbour);
  const double* value = this->Vertices.values.at(neighbour.to);
  this->RowSum += weight;
  this->addEdge(i, neighbour, weight);
  if (this->Vertices.isSolved())
  {
    // Nobody listens to the rows of a correction.
    this->addFlow(weight, i, neighbour.to);
    if (target)
    {
      this->addTarget(weight, target);
    }
    return;
  }
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    const double term = weight * (value[k] + (target ? target[k] : 0.0));
    this->B[k] += term;
    this->Constraint[k] += term;
  }
  if (this->Listener)
  {
    this->Listener->link(delta, weight);
  }
}

/** Adds the edge target of an entry: sum_j w_ij d_ij on the right-hand side pulls u_i - u_j towards
 * d_ij. */
void RowAssembly::addTarget(double weight, const double* target)
{
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->B[k] += weight * target[k];
  }
  if (this->Listener)
  {
    this->Listener->target(target);
  }
}

/** If the diagonal is lost in rounding, raises it and adds the same multiple of the initial value
 * to b, which keeps the vertex near that value. See lostDiagonalOf(). */
void RowAssembly::regularise(std::int64_t i)
{
  this->Raise =
    this->Kind == Weights::Cotangent ? lostDiagonal(this->weights(), this->RowSum) : 0.0;
  if (this->Raise == 0.0)
  {
    return;
  }
  ++this->Raised;
  this->RowSum += this->Raise;
  const double* x = this->initial(i);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->B[k] += this->Raise * x[k];
    this->Constraint[k] += this->Raise * x[k];
  }
}

/** Adds the row to the initial residual and to the sums over its component. */
void RowAssembly::count(std::int64_t i, const FinalVertices::Vertex& vertex, const double* jumps)
{
  // What is beyond the ordinary weights: the share of screening and the like, and the excess of
  // slivers.
  const double share = commonShare(vertex.rowSum + (this->Edges - this->Ordinary), this->Ordinary);
  const AssembledRow row{ this->Row, this->weights(),
    nonZeroDiagonal(
      std::accumulate(this->Weight.begin(), this->Weight.begin() + this->Size, this->RowSum)) };
  const double* x = this->initial(i);
  // The initial values of a correction are the same zeros for all vertices.
  const std::int64_t stride =
    this->Vertices.isSolved() ? 0 : static_cast<std::int64_t>(this->Columns);
  const std::span<const double> residual =
    this->Residual.add(row, x, this->B.data(), stride, share);
  if (this->Raise > 0.0)
  {
    // What keeps the vertex near its initial value is not part of the problem, nor of the condition
    // that a free component has a solution. It cancels in the residual.
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      this->B[k] -= this->Raise * x[k];
    }
  }
  if (vertex.label >= 0)
  {
    this->Residual.varying.add(
      vertex.label, this->RowSum - this->Raise, vertex.weight, this->B.data(), share);
  }
  if (vertex.counts && jumps)
  {
    // The mean that is kept is that of all vertices, of which some are more than their unknown.
    this->Mean.assign(x, x + this->Columns);
    std::transform(x, x + this->Columns, jumps, this->Mean.begin(), std::minus<>());
    x = this->Mean.data();
  }
  if (vertex.counts)
  {
    this->Parts.count(vertex.label, this->B.data(), x, residual.data(), vertex.weight);
  }
  if (this->Listener)
  {
    this->Listener->unknown(share, vertex.label, vertex.rowSum + this->Raise);
  }
}

} // namespace smg
