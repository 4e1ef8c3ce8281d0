// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Gmsh .msh 2.2 and 4.1, text and binary, elements of any order. */
extern const Format GmshFormat;

void importGmsh(InputFile& file, RawMeshBuilder& builder);
/**
 * Gmsh 2.2 as text: triangles and quadrilaterals, or tetrahedra, and two tags of each. Polygons of
 * more corners become triangles.
 */
WriteNotes writeRestoredGmsh(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfGmsh(const MeshToWrite& written);

} // namespace smg
