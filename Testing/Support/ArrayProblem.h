// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Problem.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace smg::testing
{

/** A problem from arrays in stream order. An empty array means zeros. */
class ArrayProblem : public Problem
{
public:
  /** d_ij of the edge from point p to point q, `columns` numbers; must be antisymmetric. */
  using EdgeTarget = std::function<void(const double* p, const double* q, double* target)>;

  int Columns = 1;
  Weights EdgeWeights = Weights::Clamped;
  double Screening = 0.0;               ///< at all vertices
  std::vector<std::uint8_t> Prescribed; ///< one per vertex
  std::vector<double> Value;            ///< `Columns` per vertex
  std::vector<double> Source;           ///< `Columns` per vertex
  EdgeTarget Target;
  bool KeepsUndetermined = true;

  int columns() const override { return this->Columns; }
  int vectorSize() const override { return this->Columns; }
  Weights weights() const override { return this->EdgeWeights; }
  bool keepsUndetermined() const override { return this->KeepsUndetermined; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;
  bool hasEdgeTargets() const override { return static_cast<bool>(this->Target); }
  void edgeTargets(EdgeBatch& batch) override;
};

/**
 * Three columns with the positions of the vertices, prescribed where z is within `fraction` of the
 * height of the mesh from its lowest or highest point. Elsewhere the initial values are the
 * positions if `start`, else zero.
 */
ArrayProblem fixedEnds(const StreamMesh& mesh, double fraction = 0.02, bool start = false);

} // namespace smg::testing
