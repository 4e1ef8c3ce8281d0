// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Results/MovedVertices.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/**
 * Writes the PLY file `in` again as `out`, in binary, with its vertices moved; see rewriteMesh().
 * Integer coordinates become float, or double if they have 32 bits; integer normals become float.
 * Throws Error; Cancelled.
 */
void rewritePly(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const ProgressFunction& progress = {});

} // namespace smg
