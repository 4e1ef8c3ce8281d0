// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/ProblemDescription.h"

#include <span>

class vtkPointSet;

namespace smg
{

/** Throws Error if the requested cell results need more than the cell itself. */
void checkCellResults(const ProblemDescription& problem);

/**
 * Adds the requested cell arrays Gradient and Flux to the output, for a piece of a mesh or its
 * preview with the solution `values` at its points. Throws Error if the piece lacks data of the
 * conductivity.
 */
void addCellResults(vtkPointSet& piece, const ProblemDescription& problem,
  std::span<const double> values, vtkPointSet& output);

} // namespace smg
