// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/FairingProblem.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>

namespace smg
{

double EdgeConductivity::factor(double curvature) const
{
  const double turns = curvature * this->Length / this->Limit;
  // The least conductivity keeps K definite.
  return std::max(1.0 / (1.0 + turns * turns * turns * turns), 1e-6);
}

std::array<double, 6> EdgeConductivity::at(
  const double* const* points, const double* const* normals) const
{
  // Axes u, v of the plane, u along the first edge.
  const Vector ab = difference(points[1], points[0]);
  const Vector ac = difference(points[2], points[0]);
  const Vector area = cross(ab, ac);
  const double width = std::sqrt(dot(ab, ab));
  const Vector u = scaled(1.0 / width, ab);
  const Vector n = scaled(1.0 / std::sqrt(dot(area, area)), area);
  const Vector v = cross(n, u);
  const double cu = dot(ac, u);
  const double cv = dot(ac, v);

  // The normal turns by (b - a) / width along u, and so that it is c at the third corner.
  const Vector alongU = scaled(1.0 / width, difference(normals[1], normals[0]));
  const Vector toC = difference(normals[2], normals[0]);
  const Vector alongV{ (toC[0] - cu * alongU[0]) / cv, (toC[1] - cu * alongU[1]) / cv,
    (toC[2] - cu * alongU[2]) / cv };
  const double uu = dot(alongU, u);
  const double vv = dot(alongV, v);
  const double uv = 0.5 * (dot(alongU, v) + dot(alongV, u));

  const double mean = 0.5 * (uu + vv);
  const double half = std::hypot(0.5 * (uu - vv), uv);
  const double angle = 0.5 * std::atan2(uv, 0.5 * (uu - vv));
  const double first = this->factor(mean + half);
  const double second = this->factor(mean - half);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
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
  if (held.empty())
  {
    return;
  }
  std::copy_n(
    this->Values.at(block.firstVertex), conditions.value.size(), conditions.value.begin());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    conditions.dirichlet[i] = held[i] ? 0 : -1;
    conditions.screening[i] = 1.0 / this->Time;
  }
  for (std::size_t k = 0; k < conditions.value.size(); ++k)
  {
    conditions.source[k] = conditions.value[k] / this->Time;
  }
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

void FairingProblem::setWeights(
  CellBatch& batch, std::size_t cell, const double* const* points) const
{
  const CellWeights own = cellWeights(batch.type, points);
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
    // Of a flat triangle, they may be lost in rounding.
    const std::span<const double> weights(across.weight, 3);
    if (std::ranges::all_of(weights, [](double weight) { return std::isfinite(weight); }) &&
        *std::ranges::max_element(weights) > 0.0)
    {
      const double factor = flatnessFactor(batch.type, points, across);
      std::ranges::transform(weights, batch.weightsOf(cell).begin(),
        [factor](double weight) { return factor * weight; });
    }
  }
  // A triangle that has collapsed keeps its stiffness at rest, and hardly any mass.
  constexpr double MinShare = 1e-6;
  batch.measure[cell] = std::max(own.measure, MinShare * rest);
}

} // namespace smg
