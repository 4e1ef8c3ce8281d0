// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/StreamAssembly.h"
#include "IO/Raw/RawMesh.h"
#include "smg/VsmReader.h"

#include <functional>

namespace smg
{

using TakeVertices = std::function<void(const IsolatedVertices& vertices)>;

/**
 * Gives the vertices of a mesh that are not in its layout, some at a time and in the file's
 * sequence, to `take`, with the vertex columns that a LayoutSource has. They are known by
 * OriginalId if the mesh has that column, else by their numbers in the file.
 */
void takeIsolatedVertices(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, const TakeVertices& take);

} // namespace smg
