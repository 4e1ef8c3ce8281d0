// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/ProblemDescription.h"

#include <span>

class vtkPointSet;

namespace smg
{

/**
 * Adds the cell arrays Gradient and Flux that the description wants to a piece of a mesh, or to its
 * preview, at whose points the solution is `values`. They need nothing but the cell itself. Throws
 * Error if the piece lacks what the conductivity is made of.
 */
void addCellResults(
  vtkPointSet& piece, const ProblemDescription& problem, std::span<const double> values);

} // namespace smg
