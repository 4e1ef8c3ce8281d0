// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "IO/External/Workspace.h"
#include "IO/Import/RawMesh.h"
#include "smg/Error.h"

namespace smg
{

/** Throws ArgumentError unless points have three columns and cells three or four of integers. */
void checkArrays(const ArrayView& points, const ArrayView& cells);

/** The mesh of arrays: vertices and cells are their rows. Throws ArgumentError, which names the
 * row, if a coordinate is not finite or a corner is not a vertex, or there are no cells; Cancelled.
 */
RawMesh importArrays(const ArrayView& points, const ArrayView& cells, Workspace& workspace,
  const ProgressFunction& progress);

} // namespace smg
