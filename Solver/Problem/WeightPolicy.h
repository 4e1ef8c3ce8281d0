// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/ProblemCells.h"
#include "smg/CellWeights.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace smg
{

/**
 * Which weights a cell gives to its edges: those of finite elements or the problem's own, and, with
 * Weights::Cotangent, scaled down where the cell is too flat. What becomes of their sums over the
 * cells of an edge is up to WeightedEdges.
 */
class WeightPolicy
{
public:
  /** `scale` is set to the size of the problem's own weights: see AssembledRows::weightScale. */
  WeightPolicy(CellType type, Problem& problem, double& scale);

  /** Makes ready for cell `c` of the block; see ProblemCells::prepare(). */
  void prepare(const MeshBlock& block, std::size_t c, const Ring<double>& points)
  {
    if (this->Own)
    {
      this->Own->prepare(block, c, points);
    }
  }

  // Of the cell that is prepared.

  /** Its weights; measure 0: it is degenerate. */
  CellWeights weigh(const std::int64_t* corners, const double* const* points, unsigned flags);
  /** Whether its corners belong together even if it is degenerate. */
  bool connectsFlat(const std::int64_t* corners, unsigned flags) const;
  /** The size of its weights; see ProblemCells::scale(). */
  double scale() const { return this->Own ? this->Own->scale() : 1.0; }
  /** What the problem says of its cells, if it does. */
  const std::optional<ProblemCells>& own() const { return this->Own; }

  std::int64_t degenerateCells() const { return this->Degenerate; }
  /** With cotangent weights: cells whose stiffness was scaled down, and the least factor. */
  std::int64_t limitedCells() const { return this->Limited; }
  double leastFlatness() const { return this->LeastFlatness; }

private:
  CellWeights limited(CellWeights cell, double flatness);

  CellType Type;
  Weights Kind;
  bool ConnectsFlat;
  std::optional<ProblemCells> Own;
  double& Scale;
  bool Scaled = false; // Scale is known
  std::int64_t Degenerate = 0, Limited = 0;
  double LeastFlatness = 1.0;
};

} // namespace smg
