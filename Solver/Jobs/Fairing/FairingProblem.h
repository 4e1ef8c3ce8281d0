// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Fairing/BoundaryCurves.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Problem/FixedVertices.h"
#include "smg/Problem.h"

#include <array>
#include <optional>

namespace smg
{

/**
 * The conductivity of anisotropic geometric diffusion (Clarenz, Diewald and Rumpf 2000), which is
 * small across edges and 1 along them. The gradient of the unit normals, linear in a triangle, is
 * its shape operator. The surface turns by the angle phi = |kappa| * length along a principal
 * direction e of curvature kappa; K is the sum of e e^T / (1 + (phi / limit)^4) over the two
 * directions, at least 1e-6 each, and 1 along the normal.
 */
class EdgeConductivity
{
public:
  /** `length` over which the surface turns, in the unit of the mesh; `limit` in radians. */
  EdgeConductivity(double length, double limit)
    : Length(length)
    , Limit(limit)
  {
  }

  /** K as xx, yy, zz, xy, yz, xz for a triangle with an area, of these corners with these unit
   * normals. */
  std::array<double, 6> at(const double* const* points, const double* const* normals) const;

private:
  double factor(double curvature) const;

  double Length, Limit;
};

/**
 * A step of implicit smoothing: (M + t L) u = M x, divided by t, with x as initial values. M is the
 * lumped mass of the mesh, or of the surface with other positions; L is the stiffness of the mesh,
 * or of that surface with EdgeConductivity.
 */
class FairingProblem : public Problem
{
public:
  /** `values` are x. The values of `held` vertices, and of those of `boundary` unless it is null,
   * are prescribed. All must outlive this. */
  FairingProblem(Pool& pool, double t, const VertexFile& values, FixedVertices& held,
    const BoundaryCurves* boundary);

  /** Takes the masses from the surface at these positions. */
  void setSurface(const VertexFile& positions);
  /** Takes the stiffness from that surface, too, with these unit normals. */
  void setEdges(const VertexFile& normals, const EdgeConductivity& conductivity);

  int columns() const override { return this->Columns; }
  int vectorSize() const override { return this->Columns; }
  bool beginsAtRest() const override { return true; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasCells() const override { return this->Surface.has_value(); }
  void cells(CellBatch& batch) override;
  std::int64_t bytes() const override
  {
    return this->Memory.used() - this->Before + this->Held.bytes();
  }

private:
  void setWeights(CellBatch& batch, std::size_t cell, const double* const* points) const;

  Pool& Memory;
  std::int64_t Before; ///< bytes in use when this was made
  int Columns;
  double Time;
  FixedVertices& Held;
  const BoundaryCurves* Boundary;
  OpenTuples Values;
  std::optional<OpenTuples> Surface, Normals;
  std::optional<EdgeConductivity> Edges;
};

} // namespace smg
