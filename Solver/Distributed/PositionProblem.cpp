// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/PositionProblem.h"

#include <cstddef>

namespace smg
{

PositionProblem::PositionProblem(const RotationProblem& rotations, std::span<const double> turns)
  : Rotations(rotations)
{
  this->Frames.reserve(turns.size() / RotationProblem::Columns);
  for (std::size_t k = 0; k < turns.size(); k += RotationProblem::Columns)
  {
    this->Frames.push_back(frameOf(turns.data() + k));
  }
}

void PositionProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const VertexHandles& handles = this->Rotations.handles();
  for (std::size_t k = 0; k < handles.mask.size(); ++k)
  {
    if (handles.mask[k] > 0)
    {
      conditions.dirichlet[k] = 0;
      for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
      {
        conditions.value[c] = handles.target[c] - block.positions[c];
      }
    }
  }
}

void PositionProblem::edgeTargets(EdgeBatch& batch)
{
  for (std::size_t e = 0; e < batch.from.size(); ++e)
  {
    const Frame& from = this->Frames[static_cast<std::size_t>(batch.from[e])];
    const Frame& to = this->Frames[static_cast<std::size_t>(batch.to[e])];
    const double* a = batch.fromPoint.data() + 3 * e;
    const double* b = batch.toPoint.data() + 3 * e;
    const double edge[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    for (int c = 0; c < Columns; ++c)
    {
      batch.target[3 * e + static_cast<std::size_t>(c)] =
        0.5 * (from.change(c, edge) + to.change(c, edge));
    }
  }
}

void PositionProblem::addStart(const MeshBlock& block, std::span<double> values) const
{
  const VertexHandles& handles = this->Rotations.handles();
  for (std::size_t k = 0; k < handles.mask.size(); ++k)
  {
    for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
    {
      values[c] = handles.mask[k] > 0 ? handles.target[c] : block.positions[c] + values[c];
    }
  }
}

} // namespace smg
