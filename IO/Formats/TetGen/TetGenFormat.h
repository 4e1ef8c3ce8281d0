// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"

namespace smg
{

/** TetGen: the .node or the .ele file; the other one lies beside it. */
extern const Format TetGenFormat;

void importTetGen(InputFile& file, RawMeshBuilder& builder);
/**
 * Two files beside each other, whichever of them is named: .node with attributes and markers, .ele
 * with attributes. Tetrahedra or triangles; polygons become triangles.
 */
WriteNotes writeRestoredTetGen(RestoredMesh& mesh, const std::filesystem::path& path);

} // namespace smg
