// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/BreadthFirstOrder.h"
#include "IO/Order/MeshCounts.h"
#include "IO/Order/StreamAssembly.h"
#include "IO/Raw/RawMesh.h"
#include "smg/Convert.h"

#include <string>
#include <vector>

namespace smg
{

/** What is known of a mesh after it was laid out. */
struct LayOutCounts
{
  MeshCounts mesh;
  PageTraffic pages;
  std::vector<std::string> notes; ///< what a user should know of the order
};

/**
 * Brings a mesh into an order as a stream, out of core. Throws Error; Cancelled.
 *
 * The parts of the workspace's progress go up to `progressEnd`.
 */
StreamLayout layOut(const RawMesh& mesh, StreamOrder order, Workspace& workspace,
  LayOutCounts& counts, double progressEnd = 1.0);

} // namespace smg
