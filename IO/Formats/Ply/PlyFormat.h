// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/**
 * Reads ASCII and both binary orders, any elements and properties in any order; polygons and
 * strips become triangles; scalar properties become columns, with nx ny nz as `Normals` and red
 * green blue (alpha) as `Colors`.
 */
void importPly(InputFile& file, RawMeshBuilder& builder);
/** With the columns as properties; see WritePly.cpp. */
MeshFileFunction makePlyWriter;
std::int64_t bytesOfPly(const MeshToWrite& written);
/** The first lines of the header of a PLY file: text, or binary in this machine's byte order. */
std::string plyFormatLines(bool text);

class MovedVertices;
/**
 * Writes the PLY file `in` again as `out`, in binary or text, with its vertices moved; see
 * rewriteMesh(). Integer coordinates become float, or double if they have 32 bits; integer normals
 * become float. Throws Error; Cancelled.
 */
void rewritePly(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const RewriteOptions& options, const ProgressFunction& progress);

} // namespace smg
