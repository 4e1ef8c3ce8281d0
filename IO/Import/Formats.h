// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/Importer.h"
#include "IO/Import/InputFile.h"

namespace smg
{

/**
 * The importers of the single formats. Use importMesh(), which knows the format.
 *
 * PLY: ASCII and both binary orders, any elements and properties in any order; polygons and strips
 * become triangles; scalar properties become columns, with nx ny nz as `Normals` and red green blue
 * (alpha) as `Colors`.
 */
IndexedMesh importPly(InputFile& file, const ImportOptions& options);
/** OBJ: `v` and `f` lines; references to textures and normals, and everything else, are ignored. */
IndexedMesh importObj(InputFile& file, const ImportOptions& options);
/** OFF as text, with or without colours, normals and texture coordinates, which are ignored. */
IndexedMesh importOff(InputFile& file, const ImportOptions& options);
/** STL, text or binary; corners with the same coordinates become one vertex. */
IndexedMesh importStl(InputFile& file, const ImportOptions& options);
/** Medit .mesh as text: triangles, quadrilaterals, tetrahedra. */
IndexedMesh importMedit(InputFile& file, const ImportOptions& options);
/** Gmsh .msh 2.x and 4.1 as text: triangles, quadrilaterals, tetrahedra, of first or second order.
 */
IndexedMesh importGmsh(InputFile& file, const ImportOptions& options);

} // namespace smg
