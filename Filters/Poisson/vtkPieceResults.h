// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/ProblemDescription.h"

#include <span>

class vtkPointSet;

namespace smg
{

/** Throws Error if the cell results that the description wants need more than the cell itself. */
void checkCellResults(const ProblemDescription& problem);

/**
 * Gives the output the cell arrays Gradient and Flux that the description wants, of a piece of a
 * mesh or its preview, at whose points the solution is `values`. Throws Error if the piece lacks
 * what the conductivity is made of.
 */
void addCellResults(vtkPointSet& piece, const ProblemDescription& problem,
  std::span<const double> values, vtkPointSet& output);

} // namespace smg
