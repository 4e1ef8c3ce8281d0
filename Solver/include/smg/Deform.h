// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Handles.h"
#include "smg/MeshSource.h"
#include "smg/Problem.h"
#include "smg/Solution.h"
#include "smg/Solve.h"

#include <memory>

namespace smg
{

/** How to deform. */
struct DeformOptions : SolveOptions
{
  Weights weights = Weights::Clamped;
  /** V-cycles of each of the two steps, at least 1; 0: until the step reaches the tolerance. */
  int cycles = 0;
};

/**
 * Deforms a mesh by handles and keeps its details: two Poisson problems on one hierarchy.
 *
 * The first spreads the handles' rotation vectors and logarithms of scale harmonically over the
 * mesh; the second finds the positions whose edges come closest to the edges at rest, turned and
 * scaled: (div d)_i = sum_j w_ij d_ij, d_ij = (s_i R_i + s_j R_j) / 2 (p_i - p_j). With k V-cycles
 * a step that takes 2 k + 1 passes: the first problem's last prolongation and the second one's
 * first restriction share a pass.
 *
 * Components of the mesh without a held vertex, and vertices without a weighted cell, stay exactly
 * as they are.
 *
 * @return the positions, three columns; report().steps tells the two steps apart
 * @throws Error as solve(), and if no vertex is held; Cancelled
 */
SMG_EXPORT std::unique_ptr<Solution> deform(
  MeshSource& mesh, Handles& handles, const DeformOptions& options = {});

} // namespace smg
