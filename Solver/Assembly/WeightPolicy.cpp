// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/WeightPolicy.h"

#include "Solver/Assembly/FlatCells.h"

#include <algorithm>

namespace smg
{

WeightPolicy::WeightPolicy(CellType type, Problem& problem, double& scale)
  : Type(type)
  , Kind(problem.weights())
  , ConnectsFlat(problem.connectsFlatCells())
  , Scale(scale)
{
  if (problem.hasCells())
  {
    this->Own.emplace(problem, type);
  }
}

CellWeights WeightPolicy::weigh(
  const std::int64_t* corners, const double* const* points, unsigned flags)
{
  CellWeights cell;
  const int count = cornersOf(this->Type);
  if (flags == 0 && !hasRepeatedCorner(corners, count))
  {
    cell = this->Own ? this->Own->weights() : cellWeights(this->Type, points);
  }
  if (cell.measure == 0.0)
  {
    ++this->Degenerate;
    const bool joins = isDistinctCell(corners, count, flags) && hasCoincidentCorners(points, count);
    this->Coincident += joins ? 1 : 0;
    return cell;
  }
  if (this->Kind != Weights::Cotangent)
  {
    return cell;
  }
  if (this->Own && !this->Scaled)
  {
    this->Scale = this->Own->scale();
    this->Scaled = true;
  }
  const double flatness = flatnessOf(this->Kind, this->Own, this->Type, points, cell);
  return flatness < 1.0 ? this->limited(cell, flatness) : cell;
}

CellWeights WeightPolicy::limited(CellWeights cell, double flatness)
{
  ++this->Limited;
  this->LeastFlatness = std::min(this->LeastFlatness, flatness);
  for (double& weight : cell.weight)
  {
    weight *= flatness;
  }
  return cell;
}

bool WeightPolicy::connectsFlat(const std::int64_t* corners, unsigned flags) const
{
  return this->ConnectsFlat && isDistinctCell(corners, cornersOf(this->Type), flags);
}

} // namespace smg
