// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Jobs/Deformation/RotationProblem.h"
#include "smg/Deform.h"
#include "smg/DistributedSolver.h"
#include "smg/Problem.h"

#include <span>
#include <vector>

namespace smg
{

/** See DistributedSolver::deform(). */
DistributedSolution deformParts(const SharedVertices& vertices, const MeshPart& part,
  Handles& handles, Weights weights, const DistributedOptions& options);

/** The second step of a deformation on a part of the mesh: the displacements u = x - p, prescribed
 * at held vertices, with the edge targets ((s_i R_i + s_j R_j) / 2 - I) (p_i - p_j). PositionStep
 * has the same equations for a stream. */
class PositionProblem final : public Problem
{
public:
  static constexpr int Columns = 3;

  /** `turns`: the solution of `rotations`, at all vertices of the part. */
  PositionProblem(const RotationProblem& rotations, std::span<const double> turns);

  int columns() const override { return Columns; }
  bool beginsAtRest() const override { return true; }
  Weights weights() const override { return this->Rotations.weights(); }
  bool connectsFlatCells() const override { return this->Rotations.connectsFlatCells(); }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasEdgeTargets() const override { return true; }
  void edgeTargets(EdgeBatch& batch) override;

  /** Replaces the displacements of the vertices of the part by their new positions; those of held
   * vertices are exactly the targets. */
  void addStart(const MeshBlock& block, std::span<double> values) const;

private:
  const RotationProblem& Rotations;
  std::vector<Frame> Frames;
};

} // namespace smg
