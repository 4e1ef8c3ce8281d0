// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Operators/Extended.h"

namespace smg
{

/** The operator set of a deformation: Extended with the most effective V-cycles, since a fixed
 * number of V-cycles per step is usually small. */
struct DeformationOperators : Extended
{
  static DeformationOperators forCells(CellType type) { return { Extended::forFewCycles(type) }; }
};

static_assert(OperatorSet<DeformationOperators>);

} // namespace smg
