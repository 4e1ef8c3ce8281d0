// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/StreamAssembly.h"
#include "IO/Raw/RawMesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace smg
{

/** Takes some vertices: their numbers, and x, y, z each. */
using TakeVertices =
  std::function<void(std::span<const std::int64_t> ids, std::span<const double> positions)>;

/** Gives the vertices of a mesh that are not in its layout, by ascending numbers, to `take`. */
void takeIsolatedVertices(
  const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace, const TakeVertices& take);

} // namespace smg
