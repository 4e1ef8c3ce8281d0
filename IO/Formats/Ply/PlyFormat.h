// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/**
 * PLY. Reads ASCII and both binary orders, any elements and properties in any order; polygons and
 * strips become triangles; scalar properties become columns, with nx ny nz as `Normals` and red
 * green blue (alpha) as `Colors`. Writes binary, with the columns as properties.
 */
extern const Format PlyFormat;

void importPly(InputFile& file, RawMeshBuilder& builder);
/** Faces are polygons; columns are properties as writePly() has them. */
WriteNotes writeRestoredPly(RestoredMesh& mesh, const std::filesystem::path& path);

} // namespace smg
