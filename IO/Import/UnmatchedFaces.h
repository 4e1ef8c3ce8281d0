// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Import/VertexFilter.h"

#include <cstdint>

namespace smg
{

/** The number of faces of the boundary of a tetrahedral mesh that lie upon others, with which they
 * share a vertex that is in `joined`, but not all vertices: as where bodies with different
 * triangles on the face between them were welded. Throws Error; Cancelled. */
std::int64_t unmatchedFaces(const RawMesh& mesh, const VertexFilter& joined, Workspace& workspace);

} // namespace smg
