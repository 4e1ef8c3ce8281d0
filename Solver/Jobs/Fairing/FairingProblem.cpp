// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/FairingProblem.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>

// One step of implicit smoothing as a Problem, and the conductivity that keeps edges (Clarenz,
// Diewald and Rumpf 2000).
//
// (M + t L) u = M x, divided by t, is a problem with the screening 1 / t and the source x / t. M
// and L are lumped masses and stiffness; only the masses, or the stiffness as well, may come from a
// surface whose positions are in a vertex file. What the problem returns depends on the vertex or
// cell alone, not on blocks. In memory are the tuples at open vertices.

namespace smg
{

double EdgeConductivity::factor(double curvature) const
{
  const double turns = curvature * this->Length / this->Limit;
  // At least 1e-6, which keeps K positive definite.
  return std::max(1.0 / (1.0 + turns * turns * turns * turns), 1e-6);
}

std::array<double, 6> EdgeConductivity::at(
  const double* const* points, const double* const* normals) const
{
  // Orthonormal axes u, v of the plane of the triangle, with u along the first edge.
  const Vector ab = difference(points[1], points[0]);
  const Vector ac = difference(points[2], points[0]);
  const Vector area = cross(ab, ac);
  const double width = std::sqrt(dot(ab, ab));
  const Vector u = scaled(1.0 / width, ab);
  const Vector n = scaled(1.0 / std::sqrt(dot(area, area)), area);
  const Vector v = cross(n, u);
  const double cu = dot(ac, u);
  const double cv = dot(ac, v);

  // The normal is linear in the triangle. Its derivative along u follows from the first two
  // corners, the one along v such that the normal at the third corner is met. Its components in the
  // plane are the shape operator, which is symmetrised.
  const Vector alongU = scaled(1.0 / width, difference(normals[1], normals[0]));
  const Vector toC = difference(normals[2], normals[0]);
  const Vector alongV{ (toC[0] - cu * alongU[0]) / cv, (toC[1] - cu * alongU[1]) / cv,
    (toC[2] - cu * alongU[2]) / cv };
  const double uu = dot(alongU, u);
  const double vv = dot(alongV, v);
  const double uv = 0.5 * (dot(alongU, v) + dot(alongV, u));

  // Eigenvalues mean +- half of the symmetric 2 x 2 matrix, and the angle from u to the first
  // principal direction.
  const double mean = 0.5 * (uu + vv);
  const double half = std::hypot(0.5 * (uu - vv), uv);
  const double angle = 0.5 * std::atan2(uv, 0.5 * (uu - vv));
  const double first = this->factor(mean + half);
  const double second = this->factor(mean - half);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  // The normal direction gets 1. It does not matter, since gradients lie in the plane, but keeps K
  // definite.
  std::array<double, 6> K{};
  constexpr int Entry[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } };
  for (std::size_t k = 0; k < 6; ++k)
  {
    const auto i = static_cast<std::size_t>(Entry[k][0]);
    const auto j = static_cast<std::size_t>(Entry[k][1]);
    const auto e = [&](std::size_t axis) { return c * u[axis] + s * v[axis]; };
    const auto f = [&](std::size_t axis) { return c * v[axis] - s * u[axis]; };
    K[k] = first * e(i) * e(j) + second * f(i) * f(j) + n[i] * n[j];
  }
  return K;
}

FairingProblem::FairingProblem(Pool& pool, double t, const VertexFile& values, FixedVertices& held,
  const BoundaryCurves* boundary)
  : Memory(pool)
  , Before(pool.used())
  , Columns(values.lanes())
  , Time(t)
  , Held(held)
  , Boundary(boundary)
  , Values(pool, values)
{
}

void FairingProblem::setSurface(const VertexFile& positions)
{
  this->Surface.emplace(this->Memory, positions);
}

void FairingProblem::setEdges(const VertexFile& normals, const EdgeConductivity& conductivity)
{
  this->Normals.emplace(this->Memory, normals);
  this->Edges = conductivity;
}

/** Sets screening and source of the step, and prescribes held vertices and the boundary curves. */
void FairingProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  this->Values.startBlock(block);
  for (std::optional<OpenTuples>* tuples : { &this->Surface, &this->Normals })
  {
    if (*tuples)
    {
      (*tuples)->startBlock(block);
    }
  }
  const std::span<const std::uint8_t> held = this->Held.at(block);
  // The block has no vertices; its tuples have been started.
  if (held.empty())
  {
    return;
  }
  std::copy_n(
    this->Values.at(block.firstVertex), conditions.value.size(), conditions.value.begin());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    // There is one Dirichlet condition, number 0.
    conditions.dirichlet[i] = held[i] ? 0 : -1;
    conditions.screening[i] = 1.0 / this->Time;
  }
  for (std::size_t k = 0; k < conditions.value.size(); ++k)
  {
    conditions.source[k] = conditions.value[k] / this->Time;
  }
  // The curves have been moved by this step already.
  if (this->Boundary)
  {
    this->Boundary->forVertices(block.firstVertex, block.vertices(),
      [&conditions](std::size_t i, const std::array<double, 3>& position)
      {
        conditions.dirichlet[i] = 0;
        std::ranges::copy(position, conditions.value.begin() + static_cast<std::ptrdiff_t>(3 * i));
      });
  }
}

/** Takes the masses, and with edges the stiffness, from the surface. Cells that have no weight at
 * rest stay without one. */
void FairingProblem::cells(CellBatch& batch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(batch.type));
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    if (batch.measure[c] == 0.0)
    {
      continue;
    }
    const double* points[4] = {};
    for (std::size_t k = 0; k < corners; ++k)
    {
      points[k] = this->Surface->at(batch.corners[c * corners + k]);
    }
    this->setWeights(batch, c, points);
  }
}

/** Sets mass and, with edges, stiffness of one cell from the surface. */
void FairingProblem::setWeights(
  CellBatch& batch, std::size_t cell, const double* const* points) const
{
  const CellWeights own = cellWeights(batch.type, points);
  // `own` is the triangle on the surface, `rest` its area in the mesh.
  const double rest = batch.measure[cell];
  if (own.measure > 0.0 && this->Edges)
  {
    const double* normals[3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      normals[k] = this->Normals->at(batch.corners[3 * cell + k]);
    }
    const CellWeights across =
      conductivityWeights(batch.type, points, this->Edges->at(points, normals).data());
    // The weights of a very flat triangle may be lost in rounding. Then it keeps the weights of the
    // mesh.
    const std::span<const double> weights(across.weight, 3);
    if (std::ranges::all_of(weights, [](double weight) { return std::isfinite(weight); }) &&
        *std::ranges::max_element(weights) > 0.0)
    {
      // The solve limits the flatness of the triangle in the mesh; this one may be flatter. K is at
      // most 1, so that the limit of K = 1 applies.
      const double factor = flatnessFactor(batch.type, points, across);
      std::ranges::transform(weights, batch.weightsOf(cell).begin(),
        [factor](double weight) { return factor * weight; });
    }
  }
  // A triangle that has collapsed keeps its stiffness at rest, but hardly any mass. Without any, it
  // would lose its weights, too.
  constexpr double MinShare = 1e-6;
  batch.measure[cell] = std::max(own.measure, MinShare * rest);
}

} // namespace smg
