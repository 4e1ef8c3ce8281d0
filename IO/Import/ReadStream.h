// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "smg/MeshSource.h"

#include <string>

namespace smg
{

/**
 * Reads a mesh stream as a raw mesh: vertices are numbered by their stream indices, elements are
 * the cells. All columns are read except CellFlags, which are computed from the cells. Throws
 * Error, which names the stream `name`.
 */
RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace);

} // namespace smg
