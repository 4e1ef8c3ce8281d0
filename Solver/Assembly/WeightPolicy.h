// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/ProblemCells.h"
#include "smg/CellWeights.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace smg
{

/**
 * The weights of a cell for its edges: those of finite elements or of the problem, and, with
 * Weights::Cotangent, scaled down if the cell is too flat. WeightedEdges processes their sums over
 * the cells of an edge.
 */
class WeightPolicy
{
public:
  /** `scale` is set to the size of the weights of the problem, see AssembledRows::weightScale. */
  WeightPolicy(CellType type, Problem& problem, double& scale);

  /** Prepares cell `c` of the block; see ProblemCells::prepare(). */
  void prepare(const MeshBlock& block, std::size_t c, const Ring<double>& points)
  {
    if (this->Own)
    {
      this->Own->prepare(block, c, points);
    }
  }

  // Of the prepared cell:

  /** Its weights; measure 0 if it is degenerate. */
  CellWeights weigh(const std::int64_t* corners, const double* const* points, unsigned flags);
  /** Whether its corners are connected even if it is degenerate. */
  bool connectsFlat(const std::int64_t* corners, unsigned flags) const;
  /** The size of its weights; see ProblemCells::scale(). */
  double scale() const { return this->Own ? this->Own->scale() : 1.0; }
  /** The data of the problem in its cells, if any. */
  const std::optional<ProblemCells>& own() const { return this->Own; }

  std::int64_t degenerateCells() const { return this->Degenerate; }
  /** Those of which corners coincide. */
  std::int64_t coincidentCells() const { return this->Coincident; }
  /** With cotangent weights: the number of cells whose stiffness was scaled down, and the least
   * factor. */
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
  std::int64_t Degenerate = 0, Coincident = 0, Limited = 0;
  double LeastFlatness = 1.0;
};

} // namespace smg
