// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Engine/SolveOptions.h"
#include "Solver/Problem/Problem.h"

namespace smg
{

/** How to deform. */
struct DeformOptions : SolveOptions
{
  Weights weights = Weights::Clamped;
  /** V-cycles of each of the two steps, at least 1; 0: until the step reaches the tolerance. */
  int cycles = 0;
};

} // namespace smg
