// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace smg
{

/** The first step of a deformation: the rotation vector (three columns) and the logarithm of the
 * scale (one column), prescribed at held vertices and harmonic elsewhere. */
class SMG_EXPORT RotationProblem : public Problem
{
public:
  static constexpr int Columns = 4;

  /** Takes the target of a held vertex; called by ascending vertex. */
  using Hold = std::function<void(std::int64_t vertex, const double* target)>;

  RotationProblem(Handles& handles, Weights weights, Hold hold = {})
    : Given(handles)
    , WeightsOfEdges(weights)
    , TakeTarget(std::move(hold))
  {
  }

  int columns() const override { return Columns; }
  bool beginsAtRest() const override { return true; }
  Weights weights() const override { return this->WeightsOfEdges; }
  /** True: a vertex that has only flat cells follows its neighbours instead of keeping its
   * position. */
  bool connectsFlatCells() const override { return true; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  std::int64_t bytes() const override { return this->Given.bytes(); }

  /** The handles at the vertices of the last block. */
  const VertexHandles& handles() const { return this->At; }
  /** The number of vertices held by several handles. */
  std::int64_t shared() const { return this->Shared; }

private:
  Handles& Given;
  Weights WeightsOfEdges;
  Hold TakeTarget;
  VertexHandles At;
  std::int64_t Shared = 0;
};

/** The rotation and scale of the mesh at a vertex, as the matrix s R - I, row by row. */
struct Frame
{
  double m[9];

  /** Component `r` of (s R - I) d. */
  double change(int r, const double* d) const
  {
    const double* row = this->m + 3 * r;
    return row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
  }
};

/**
 * s R - I of a rotation vector (unit axis times angle in radians) and the logarithm of s: R - I =
 * sin(a)/a K + (1 - cos(a))/a^2 K^2 (Rodrigues), K the cross product with the vector. Equally
 * accurate for small angles and scales near 1; exactly zero for four zeros.
 */
inline Frame frameOf(const double* rotationAndLogScale)
{
  const double x = rotationAndLogScale[0];
  const double y = rotationAndLogScale[1];
  const double z = rotationAndLogScale[2];
  const double growth = std::expm1(rotationAndLogScale[3]);
  const double square = x * x + y * y + z * z;
  const double angle = std::sqrt(square);
  // Below this angle the second terms of the series are smaller than the rounding of the first
  // ones.
  constexpr double Small = 1e-8;
  const double half = std::sin(0.5 * angle);
  const double s = (1.0 + growth) * (angle < Small ? 1.0 : std::sin(angle) / angle);
  const double c = (1.0 + growth) * (angle < Small ? 0.5 : 2.0 * half * half / square);
  return { { growth - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y, c * x * y + s * z,
    growth - c * (x * x + z * z), c * y * z - s * x, c * x * z - s * y, c * y * z + s * x,
    growth - c * (x * x + y * y) } };
}

/** Throws Error unless the arrays have the sizes for this many vertices. */
SMG_EXPORT void checkSize(const VertexHandles& handles, std::int64_t vertices);

/** Throws Error if the values at held vertex `k` of the arrays, vertex `i` of the mesh, are not
 * finite or out of range. */
SMG_EXPORT void checkHeld(const VertexHandles& handles, std::size_t k, std::int64_t i);

} // namespace smg
