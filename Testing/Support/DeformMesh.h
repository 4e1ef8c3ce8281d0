// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/SolveMesh.h"
#include "smg/Deform.h"

#include <cstdint>
#include <memory>

namespace smg::testing
{

inline constexpr Weights BothWeights[] = { Weights::Uniform, Weights::Clamped };

/** Deforms a mesh that is read in blocks of `blockCells` cells. */
inline Solved deformMesh(const StreamMesh& mesh, Handles& handles,
  const DeformOptions& options = {}, std::int64_t blockCells = 1000)
{
  MemorySource source(mesh, blockCells);
  const std::unique_ptr<Solution> solution = deform(source, handles, options);
  return { valuesOf(*solution), solution->report() };
}

/** Options for `cycles` V-cycles per step. */
inline DeformOptions withCycles(int cycles, Weights weights = Weights::Clamped)
{
  DeformOptions options;
  options.weights = weights;
  options.cycles = cycles;
  return options;
}

/** Options for steps that converge to a tolerance. */
inline DeformOptions byTolerance(double tolerance, Weights weights = Weights::Clamped)
{
  DeformOptions options;
  options.weights = weights;
  options.tolerance = tolerance;
  return options;
}

} // namespace smg::testing
