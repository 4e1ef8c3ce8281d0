// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/Importer.h"
#include "IO/Import/InputFile.h"
#include "IO/Raw/RawMeshBuilder.h"

namespace smg
{

/**
 * The parsers of the single formats. Use importMesh(), which knows the format. They give the mesh
 * to the builder; a MeshError of the builder becomes an Error with the place in the file.
 *
 * PLY: ASCII and both binary orders, any elements and properties in any order; polygons and strips
 * become triangles; scalar properties become columns, with nx ny nz as `Normals` and red green blue
 * (alpha) as `Colors`.
 */
void importPly(InputFile& file, RawMeshBuilder& builder);
/** OBJ: `v` and `f` lines; references to textures and normals, and everything else, are ignored. */
void importObj(InputFile& file, RawMeshBuilder& builder);
/** OFF as text, with or without colours, normals and texture coordinates, which are ignored. */
void importOff(InputFile& file, RawMeshBuilder& builder);
/** STL, text or binary; corners with the same coordinates become one vertex. */
void importStl(InputFile& file, RawMeshBuilder& builder);
/** Medit .mesh as text. */
void importMedit(InputFile& file, RawMeshBuilder& builder);
/** Gmsh .msh 2.2 and 4.1, text and binary, elements of any order. */
void importGmsh(InputFile& file, RawMeshBuilder& builder);
/** TetGen: `file` is the .node or the .ele file, the other one lies beside it. */
void importTetGen(InputFile& file, RawMeshBuilder& builder);
/** Legacy VTK, text and binary, polygonal data and unstructured grids, layouts 2.0 to 5.1. */
void importLegacyVtk(InputFile& file, RawMeshBuilder& builder);
/**
 * VTK XML (.vtp, .vtu): appended and inline data, as text, base64 or raw, plain or compressed by
 * zlib or LZ4. What is compressed otherwise goes to the VtkImporter.
 */
void importVtkXml(InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress);
/** The pieces that a .pvtp or .pvtu file names, one after the other. */
void importParallelVtkXml(
  InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress);

} // namespace smg
