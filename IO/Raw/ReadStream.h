// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMesh.h"
#include "Solver/Stream/MeshSource.h"

namespace smg
{

/**
 * Takes a mesh stream as a raw mesh: vertices are known by their stream indices, elements are the
 * cells. All columns are taken, but for CellFlags, which follow from the cells. Throws Error.
 */
RawMesh readStream(MeshSource& source, Workspace& workspace);

} // namespace smg
