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

/**
 * How to deform: the options of a solve, which hold for each of the two steps, and these.
 * `operators` must be "extended".
 */
struct DeformOptions : SolveOptions
{
  /** Weights of the edges, in both steps. */
  Weights weights = Weights::Clamped;
  /** V-cycles of each step, whatever the residual; 0: as many as `tolerance` takes, `maxCycles`
   * at most. */
  int cycles = 0;
};

/**
 * Deforms a mesh by handles and keeps its details: two Poisson problems on one hierarchy.
 *
 * The rotation step spreads the handles' rotation vectors and logarithms of scale harmonically over
 * the mesh. The position step finds the positions whose edges are closest, in the weighted
 * least-squares sense, to the edges at rest, rotated and scaled: its right-hand side is
 * (div d)_i = sum_j w_ij d_ij, d_ij = (s_i R_i + s_j R_j) / 2 (p_i - p_j), which for scales of 1 is
 * that of Sorkine and Alexa 2007. With k V-cycles a step this takes 2 k + 1 passes over the mesh:
 * the last prolongation of the first step and the first restriction of the second one share a pass.
 *
 * Components of the mesh without a held vertex, and vertices without a weighted cell, stay exactly
 * where they are.
 *
 * @param mesh the mesh stream, read once
 * @param handles the handles, asked once for each block
 * @param options how to solve
 * @return the positions: three columns, x, y, z, in the unit of the mesh. Solution::report() has
 * both steps in Report::steps.
 * @throws Error as solve(), if no vertex is held, or if what `handles` sets is not valid (see
 * Handles::at())
 * @throws Cancelled if the progress callback returns false
 */
SMG_EXPORT std::unique_ptr<Solution> deform(
  MeshSource& mesh, Handles& handles, const DeformOptions& options = {});

} // namespace smg
