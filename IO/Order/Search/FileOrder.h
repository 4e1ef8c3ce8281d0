// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "smg/VsmReader.h"

#include <functional>

namespace smg
{

/** The vertices in the order in which the cells of the file first use them; isolated ones are left
 * out. */
OrderedVertices firstUseOrder(const RawMesh& mesh, Workspace& workspace);

using TakeVertices = std::function<void(const IsolatedVertices& vertices)>;

/** Passes the vertices of a mesh that are not in its layout to `take`, in chunks and in the order
 * of the file, with the vertex columns that a LayoutSource has. They are numbered by OriginalId if
 * the mesh has that column, otherwise by their numbers in the file. */
void takeIsolatedVertices(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, const TakeVertices& take);

} // namespace smg
