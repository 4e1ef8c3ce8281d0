// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Problem.h"

#include <string>
#include <vector>

namespace smg
{

/** Which vertex columns of a mesh stream make a Poisson problem; an empty name: there is none. */
struct ColumnProblemNames
{
  std::string mask;   ///< not 0: the vertex is constrained (one component)
  std::string values; ///< the prescribed values
  std::string source; ///< source densities
  std::string guess;  ///< initial values of the free vertices; without it, 0
};

/**
 * A Poisson problem whose conditions stand in the vertex columns of the mesh stream. The number of
 * components of `values`, `source` and `guess`, which must agree, is the number of right-hand
 * sides.
 */
class ColumnProblem : public Problem
{
public:
  /** Throws Error if a column is absent or its components do not fit, or none is named. */
  ColumnProblem(
    const StreamInfo& info, const ColumnProblemNames& names, Weights weights, double screening);

  /** Throws Error if no mesh can make a problem of these names. */
  static void check(const ColumnProblemNames& names);

  int columns() const override { return this->Columns; }
  Weights weights() const override { return this->WeightsOfEdges; }
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

private:
  double finite(
    const Column& column, const MeshBlock& block, std::int64_t vertex, int component) const;

  int Mask = -1, Values = -1, Source = -1, Guess = -1; ///< places in MeshBlock::vertexColumns
  int Columns = 0;
  Weights WeightsOfEdges;
  double Screening;
};

} // namespace smg
