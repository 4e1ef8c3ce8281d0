// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Medit .mesh as text. */
extern const Format MeditFormat;

void importMedit(InputFile& file, RawMeshBuilder& builder);
/**
 * Triangles, then quadrilaterals, or tetrahedra, and references. Polygons of more corners become
 * triangles.
 */
WriteNotes writeRestoredMedit(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfMedit(const MeshToWrite& written);

} // namespace smg
