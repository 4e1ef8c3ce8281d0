// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/RestShape.h"
#include "smg/Deform.h"
#include "smg/Problem.h"

namespace smg
{

/** The first step of a deformation: the rotation vector (three columns) and the logarithm of the
 * scale (one column), prescribed at held vertices and harmonic elsewhere. */
class RotationProblem : public Problem
{
public:
  static constexpr int Columns = 4;

  /** `rest` receives the targets. */
  RotationProblem(Handles& handles, Weights weights, RestShape& rest)
    : Given(handles)
    , WeightsOfEdges(weights)
    , Rest(rest)
  {
  }

  int columns() const override { return Columns; }
  Weights weights() const override { return this->WeightsOfEdges; }
  /** A vertex of flat cells only follows its neighbours instead of keeping its position. */
  bool connectsFlatCells() const override { return true; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

  /** The number of vertices held by several handles. */
  std::int64_t shared() const { return this->Shared; }

private:
  Handles& Given;
  Weights WeightsOfEdges;
  RestShape& Rest;
  VertexHandles At;
  std::int64_t Shared = 0;
};

} // namespace smg
