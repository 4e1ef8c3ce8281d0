// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/StreamedSolution.h"

#include "Solver/Multigrid/Engine/CheckOptions.h"

#include <utility>

namespace smg
{

StreamedSolution::StreamedSolution(
  std::unique_ptr<SolveContext> context, LevelWindow<double> window)
  : Context(std::move(context))
  , Window(std::move(window))
{
}

void StreamedSolution::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  checkVertexRange(
    first, count, values.size() / static_cast<std::size_t>(this->columns()), this->vertices());
  this->Context->readCompleted(this->Window, first, count, values);
}

void StreamedSolution::removeCheckpoint()
{
  if (this->Context->checkpoint)
  {
    this->Context->checkpoint->discard();
  }
}

} // namespace smg
