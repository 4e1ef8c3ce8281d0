// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Search/BreadthFirstOrder.h"
#include "smg/Convert.h"

#include <string>
#include <vector>

namespace smg
{

/** The properties of a mesh in stream order. */
struct LayOutCounts
{
  MeshCounts mesh;
  PageTraffic pages;
  std::vector<std::string> notes; ///< notes for the user on the order
};

/**
 * Brings a mesh into a stream order, out of core. Throws Error; Cancelled.
 *
 * The progress of the workspace is advanced up to `progressEnd`.
 */
StreamLayout layOut(const RawMesh& mesh, StreamOrder order, Workspace& workspace,
  LayOutCounts& counts, double progressEnd = 1.0);

} // namespace smg
