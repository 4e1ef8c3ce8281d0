// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** TetGen: the .node or the .ele file; the other one is in the same folder. */
extern const Format TetGenFormat;

void importTetGen(InputFile& file, RawMeshBuilder& builder);
/** Two files in the same folder, either of which may be named: .node with attributes and markers,
 * .ele with attributes. Tetrahedra or triangles; polygons become triangles. */
WriteNotes writeRestoredTetGen(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfTetGen(const MeshToWrite& written);

} // namespace smg
