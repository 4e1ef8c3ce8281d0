// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Operators/Extended.h"

namespace smg
{

/**
 * The operator set of a deformation: Extended with the best V-cycles, since whoever gives the
 * number of them for a step relies on what few achieve.
 */
struct DeformationOperators : Extended
{
  static DeformationOperators forCells(CellType type) { return { Extended::forFewCycles(type) }; }
};

static_assert(OperatorSet<DeformationOperators>);

} // namespace smg
