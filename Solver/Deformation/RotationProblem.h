// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/RestShape.h"
#include "smg/Handles.h"
#include "smg/Problem.h"

namespace smg
{

/**
 * The first step of a deformation: the rotation vector (three columns) and the logarithm of the
 * scale (one) are prescribed where a handle holds the mesh, and harmonic between.
 */
class RotationProblem : public Problem
{
public:
  static constexpr int Columns = 4;

  /** `rest` is told the targets. */
  RotationProblem(Handles& handles, Weights weights, RestShape& rest)
    : Given(handles)
    , WeightsOfEdges(weights)
    , Rest(rest)
  {
  }

  int columns() const override { return Columns; }
  Weights weights() const override { return this->WeightsOfEdges; }
  /** A vertex in flat cells alone goes with its neighbours, instead of staying behind. */
  bool connectsFlatCells() const override { return true; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

  /** Vertices that more than one handle holds. */
  std::int64_t shared() const { return this->Shared; }

private:
  Handles& Given;
  Weights WeightsOfEdges;
  RestShape& Rest;
  VertexHandles At;
  std::int64_t Shared = 0;
};

} // namespace smg
