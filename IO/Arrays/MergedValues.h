// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/OriginalOrder.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Solve.h"
#include "smg/WriteMesh.h"

#include <memory>
#include <vector>

namespace smg
{

/**
 * Gives points that were merged with others (OriginalOrder::merged()), which are vertices of no
 * cell, the values of a solution at these: WriteMeshOptions::changeIsolated of a result.
 * @param mesh of the solution, which is read
 * @param columns of the result that the solution has, one after the other
 * @return empty if there are no such points
 * @throws Error if the mesh cannot be read; Cancelled
 */
SMG_EXPORT CompleteIsolated mergedValues(const StoredMesh& mesh,
  const std::shared_ptr<const OriginalOrder>& order, Solution& solution,
  const std::vector<ColumnSpec>& columns, const ProgressFunction& progress = {});

} // namespace smg
