// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMesh.h"
#include "smg/MeshSource.h"

#include <string>

namespace smg
{

/**
 * Takes a mesh stream as a raw mesh: vertices are known by their stream indices, elements are the
 * cells. All columns are taken, but for CellFlags, which follow from the cells. Throws Error, which
 * calls the stream `name`.
 */
RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace);

} // namespace smg
