// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

class MovedVertices;
/**
 * Writes the streaming mesh file `in` again as `out`, another or the same of the four formats, with
 * its vertices moved; see rewriteMesh(). Comments are kept in text. Throws Error; Cancelled.
 */
void rewriteStream(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const ProgressFunction& progress, const std::function<void()>& beforeEnd);

} // namespace smg
