// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Problem.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace smg::testing
{

/** An edge between two stream indices, the smaller one first. */
struct EdgeWeight
{
  std::int32_t from;
  std::int32_t to;
  double weight;
};

/** Sums the weights of the cells of a stream for each edge, and their sizes for each vertex. */
class EdgeWeights
{
public:
  /** `connectsFlat`: see Problem::connectsFlatCells. Throws Error for 2^31 vertices and more. */
  EdgeWeights(const StreamInfo& info, Weights kind, bool connectsFlat = false);

  /** Adds the cells of the next block of the stream, given the positions of all vertices so far. */
  void add(const MeshBlock& block, const std::vector<double>& positions);
  /**
   * At the end of the stream: one weight per edge, at least its floor, sorted by `from` and `to`.
   */
  void finish(const std::vector<double>& positions);

  const std::vector<EdgeWeight>& edges() const { return this->Edges; }
  /** Lumped area or volume of each vertex. */
  const Eigen::VectorXd& mass() const { return this->Mass; }
  std::int64_t degenerateCells() const { return this->DegenerateCells; }
  std::int64_t clampedWeights() const { return this->ClampedWeights; }

private:
  CellType Type;
  Weights Kind;
  bool ConnectsFlat;
  std::vector<EdgeWeight> Edges;
  Eigen::VectorXd Mass;
  std::int64_t DegenerateCells = 0;
  std::int64_t ClampedWeights = 0;
};

} // namespace smg::testing
