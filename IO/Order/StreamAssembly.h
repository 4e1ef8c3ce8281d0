// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Raw/RawMesh.h"
#include "Solver/Stream/MeshSource.h"

#include <memory>

namespace smg
{

/** What was counted while a stream was put together. */
struct AssemblyCounts
{
  std::int64_t degenerateCells = 0;
  std::int64_t duplicateCells = 0;
  std::int64_t invertedCells = 0; ///< tetrahedra of negative volume; 0 for triangles
};

} // namespace smg
