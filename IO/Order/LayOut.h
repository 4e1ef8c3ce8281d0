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
 * Brings a mesh into an order as a stream, out of core. Throws Error; Cancelled.
 *
 * The parts of the workspace's progress go up to `progressEnd`.
 */
StreamLayout layOut(const RawMesh& mesh, StreamOrder order, Workspace& workspace,
  LayOutCounts& counts, double progressEnd = 1.0);

} // namespace smg
