// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Blend.h"
#include "smg/Deform.h"
#include "smg/Distance.h"
#include "smg/Export.h"
#include "smg/Smooth.h"
#include "smg/Solve.h"

#include <cstdint>
#include <string>

namespace smg
{

/** What a computation is expected to cost. */
struct Costs
{
  std::int64_t memory = 0;  ///< most accounted memory at once, bytes
  std::int64_t scratch = 0; ///< most bytes of scratch files at once
  std::int64_t kept = 0;    ///< bytes of scratch files that stay until the solution is written
  int passes = 0;           ///< passes over the mesh
  double seconds = 0;       ///< processor time
};

/**
 * The expected costs of a computation on a stream, from its numbers of vertices and cells and its
 * span, which must be known. The constants are measured: see docs/performance.md#estimates. Meshes
 * with many slivers take more V-cycles.
 */
/** `contrast`: the factor by which conductivities differ. Where that is large, a solve computes a
 * correction of its solution. */
SMG_EXPORT Costs solveCosts(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, double contrast = 1.0);
SMG_EXPORT Costs deformCosts(const StreamInfo& info, const DeformOptions& options);
/** `components`: the number of components of the smoothed column; 3 for positions. */
SMG_EXPORT Costs smoothCosts(const StreamInfo& info, int components, const Smoothing& options);
/** `components`: the number of components of all blended columns together. */
SMG_EXPORT Costs blendCosts(
  const StreamInfo& info, int components, SeamGradient seam, const SolveOptions& options);

SMG_EXPORT Costs distanceCosts(const StreamInfo& info, const DistanceDescription& description);

/** The components of a column of the vertices; `usual` if the mesh is not known to have it. */
SMG_EXPORT int expectedComponents(const StreamInfo& info, const std::string& column, int usual);

/** The span that the breadth-first order of a mesh with this many vertices usually has. */
SMG_EXPORT std::int64_t usualSpan(CellType cells, std::int64_t vertices);

} // namespace smg
