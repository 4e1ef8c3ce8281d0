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

/** Options of deform(). */
struct DeformOptions : SolveOptions
{
  Weights weights = Weights::Clamped;
  /** V-cycles of each of the two steps, at least 1; 0: until the step reaches the tolerance. */
  int cycles = 0;
};

/**
 * Deforms a mesh by handles and keeps its details: two Poisson problems on one hierarchy.
 *
 * The first interpolates the rotation vectors and logarithms of scale of the handles harmonically
 * over the mesh; the second computes the positions whose edges are closest to the edges at rest,
 * rotated and scaled: (div d)_i = sum_j w_ij d_ij, d_ij = (s_i R_i + s_j R_j) / 2 (p_i - p_j). With
 * k V-cycles per step this takes 2 k + 1 passes: the last prolongation of the first problem and the
 * first restriction of the second problem share a pass.
 *
 * Components of the mesh without a held vertex, and vertices without a weighted cell, are not
 * modified.
 *
 * @return the positions, three columns; report().steps describes the two steps
 * @throws Error like solve(), and if no vertex is held; Cancelled
 */
SMG_EXPORT std::unique_ptr<Solution> deform(
  MeshSource& mesh, Handles& handles, const DeformOptions& options = {});

} // namespace smg
