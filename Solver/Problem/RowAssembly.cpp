// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/RowAssembly.h"

#include "Solver/Problem/CommonShare.h"
#include "Solver/Problem/RowShortfall.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{
namespace
{

/**
 * A weight is large beside those of regular cells: of triangles, and of tetrahedra for an edge of
 * length 1. A chain of slivers with weights w conducts as 1 / w does, so the rounding of its
 * weights to single precision may move the solution by 6e-8 w^2 of its range. What smaller weights
 * than these do moved it by 2e-7 (bunny_tet.mesh, dragon.ply) or less; all weights, by 2e-5.
 */
constexpr double LargeOfTriangles = 3.0;
constexpr double LargeOfTetrahedra = 4.0;

double squaredDistance(const double* a, const double* b)
{
  const double d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

} // namespace

RowAssembly::RowAssembly(CellType type, const OpenVertices& vertices, Problem& problem,
  AssembledRows& rows, Components& components, StiffRows stiff, RowListener* listener)
  : Vertices(vertices)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Type(type)
  , Kind(problem.weights())
  , Out(rows)
  , Parts(components)
  , Stiff(stiff)
  , Listener(listener)
  , B(this->Columns)
  , Constraint(this->Columns)
  , Residual(this->Columns)
{
}

void RowAssembly::close(std::int64_t i, std::int32_t label,
  std::span<const RowNeighbour> neighbours, const double* target, double alpha, const double* load)
{
  const double* x = this->Vertices.values.at(i);
  this->Out.x.insert(this->Out.x.end(), x, x + this->Columns);
  if (this->Vertices.dirichlet[i] >= 0 || (neighbours.empty() && alpha == 0.0))
  {
    this->closeKnown(i, label);
    return;
  }
  // A vertex of flat cells alone has no component, but perhaps a facet.
  if (alpha > 0.0 && label >= 0)
  {
    this->Parts.anchor(label);
  }
  this->B.assign(load, load + this->Columns);
  this->Constraint = this->B;
  const double own = alpha;
  this->addNeighbours(i, neighbours, target, alpha);
  this->raise(i, alpha);
  float least = 0.0F;
  for (std::int64_t e = 0; this->Stiff.any() && e < this->Size; ++e)
  {
    least = std::min(least, this->Row[e].weight());
  }
  const double diagonal =
    diagonalOf({ this->Row, static_cast<std::size_t>(this->Size) }, alpha, this->Precise);
  this->Out.rows.close(this->Size, alpha, -1, this->Stiff(least), this->Precise);
  this->Out.b.insert(this->Out.b.end(), this->B.begin(), this->B.end());
  if (this->Listener)
  {
    this->Listener->constraint(this->Constraint.data());
  }
  this->count(i, label, diagonal, commonShare(own, this->edgeWeights()));
}

/** A vertex that is no unknown: prescribed, or held where it is. */
void RowAssembly::closeKnown(std::int64_t i, std::int32_t label)
{
  const double* x = this->Vertices.values.at(i);
  ++(this->Vertices.dirichlet[i] >= 0 ? this->Prescribed : this->Held);
  if (label >= 0)
  {
    this->Parts.anchor(label);
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
 * Whether the rounding of a weight to single precision would show in the solution: that of the
 * large weights of slivers is of the size of other cells' weights. It is a matter of the edge, so
 * that both of its rows agree and the matrix stays symmetric.
 */
bool RowAssembly::needsPrecision(std::int64_t i, const RowNeighbour& neighbour) const
{
  if (this->Kind != Weights::Cotangent)
  {
    return false;
  }
  const double size = neighbour.weight / this->Out.weightScale;
  if (this->Type == CellType::Triangle)
  {
    return std::fabs(size) > LargeOfTriangles;
  }
  const double square =
    squaredDistance(this->Vertices.points.at(i), this->Vertices.points.at(neighbour.to));
  return size * size > LargeOfTetrahedra * LargeOfTetrahedra * square;
}

/** Makes the row's entries; adds what the neighbours bring to b, and the weights of those that are
 * prescribed to alpha. */
void RowAssembly::addNeighbours(
  std::int64_t i, std::span<const RowNeighbour> neighbours, const double* target, double& alpha)
{
  this->Row = this->Out.rows.open(static_cast<std::int64_t>(neighbours.size()));
  this->Size = 0;
  this->Known = 0.0;
  this->Precise.clear();
  bool anyPrecise = false;
  for (const RowNeighbour& neighbour : neighbours)
  {
    const bool known = this->Vertices.dirichlet[neighbour.to] >= 0;
    const bool precise = !known && this->needsPrecision(i, neighbour);
    const auto stored = static_cast<float>(neighbour.weight);
    const double weight = known     ? knownWeight(this->Kind, neighbour)
                          : precise ? neighbour.weight
                                    : stored;
    const double* other = this->Vertices.values.at(neighbour.to);
    const auto term = [&](std::size_t k)
    { return weight * ((known ? other[k] : 0.0) + (target ? target[k] : 0.0)); };
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      this->B[k] += term(k);
    }
    const std::int64_t delta = neighbour.to - i;
    if (delta > RowEntry::MostDistance || delta < -RowEntry::MostDistance)
    {
      throw Error("vertices " + std::to_string(i) + " and " + std::to_string(neighbour.to) +
                  " share an edge but lie too far apart in the stream: convert the mesh with the "
                  "order bfs");
    }
    if (!known)
    {
      this->Row[this->Size++] = { static_cast<std::int32_t>(delta), stored };
      this->Precise.push_back(weight);
      anyPrecise = anyPrecise || precise;
      if (this->Listener && target)
      {
        this->Listener->target(target);
      }
    }
    else
    {
      alpha += weight;
      this->Known += std::fabs(weight);
      for (std::size_t k = 0; this->Listener && k < this->Columns; ++k)
      {
        this->Constraint[k] += term(k);
      }
      if (this->Listener)
      {
        this->Listener->link(static_cast<std::int32_t>(delta), stored);
      }
    }
    target = target ? target + this->Columns : nullptr;
  }
  if (!anyPrecise)
  {
    this->Precise.clear();
  }
}

/** Holds the vertex near its initial value where its diagonal is lost in rounding. */
void RowAssembly::raise(std::int64_t i, double& alpha)
{
  this->Raise =
    this->Kind == Weights::Cotangent
      ? rowShortfall({ this->Row, static_cast<std::size_t>(this->Size) }, alpha, this->Precise)
      : 0.0;
  if (this->Raise == 0.0)
  {
    return;
  }
  ++this->Raised;
  alpha += this->Raise;
  const double* x = this->Vertices.values.at(i);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->B[k] += this->Raise * x[k];
    this->Constraint[k] += this->Raise * x[k];
  }
}

/** The magnitudes of the weights of the row's edges, to prescribed vertices, too. */
double RowAssembly::edgeWeights() const
{
  double weights = this->Known;
  for (std::int64_t e = 0; e < this->Size; ++e)
  {
    weights += std::fabs(static_cast<double>(this->Row[e].weight()));
  }
  return weights;
}

/** Adds the row to the sums over all rows and over its component. */
void RowAssembly::count(std::int64_t i, std::int32_t label, double diagonal, double share)
{
  const double* x = this->Vertices.values.at(i);
  double squares[2] = { 0.0, 0.0 };
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    double sum = this->B[k] - diagonal * x[k];
    for (std::int64_t e = 0; e < this->Size; ++e)
    {
      const double weight = this->Precise.empty() ? static_cast<double>(this->Row[e].weight())
                                                  : this->Precise[static_cast<std::size_t>(e)];
      sum += weight * this->Vertices.values.at(i + this->Row[e].delta())[k];
    }
    this->Residual[k] = sum;
    squares[0] += sum * sum;
    squares[1] += this->B[k] * this->B[k] + diagonal * diagonal * x[k] * x[k];
  }
  this->InitialSquares += share * share * squares[0];
  this->TermSquares += squares[1];
  if (this->Raise > 0.0)
  {
    // What holds the vertex near its initial value is no part of the problem.
    for (std::size_t k = 0; k < this->Columns; ++k)
    {
      this->B[k] -= this->Raise * x[k];
    }
  }
  if (label >= 0)
  {
    this->Parts.count(label, this->B.data(), x, this->Residual.data(), this->Vertices.mass[i]);
  }
}

} // namespace smg
