// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"
#include "smg/Problem.h"

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
  Weights weights() const override { return this->WeightsOfEdges; }
  /** A vertex of flat cells only follows its neighbours instead of keeping its position. */
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

} // namespace smg
