// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Restore/RestoredMesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * The writers of the single formats. Use writeRestored(), which knows the format. Each reads the
 * mesh once and answers a sentence for each thing that the format does not hold as the mesh has it.
 * The file gets its name when it is complete. They throw Error and Cancelled; nothing is left of
 * the file then.
 */
using RestoredNotes = std::vector<std::string>;

/** Binary, with the columns as properties, as writePly() has them. Faces are polygons. */
RestoredNotes writeRestoredPly(RestoredMesh& mesh, const std::filesystem::path& path);
/** .vtp (polygons) or .vtu (triangles, quadrilaterals, polygons or tetrahedra), with all columns.
 */
RestoredNotes writeRestoredVtkXml(RestoredMesh& mesh, const std::filesystem::path& path);
/**
 * Legacy VTK, binary, version 3.0, which everybody reads: polygonal data, or an unstructured grid
 * of tetrahedra, with all columns as field data. Corners are 32-bit numbers.
 */
RestoredNotes writeRestoredVtk(RestoredMesh& mesh, const std::filesystem::path& path);
/** Polygons; vertices with their colours. */
RestoredNotes writeRestoredObj(RestoredMesh& mesh, const std::filesystem::path& path);
/** Polygons with their colours; vertices with normals, colours and texture coordinates. */
RestoredNotes writeRestoredOff(RestoredMesh& mesh, const std::filesystem::path& path);
/**
 * Triangles with their corners' coordinates: binary if these are single precision numbers, else
 * text, which holds them exactly. There is no place for isolated vertices.
 */
RestoredNotes writeRestoredStl(
  RestoredMesh& mesh, const std::filesystem::path& path, Workspace& workspace);
/**
 * Medit as text: triangles, then quadrilaterals, or tetrahedra, and references. Polygons of more
 * corners become triangles.
 */
RestoredNotes writeRestoredMedit(RestoredMesh& mesh, const std::filesystem::path& path);
/**
 * Gmsh 2.2 as text: triangles and quadrilaterals, or tetrahedra, and two tags of each. Polygons of
 * more corners become triangles.
 */
RestoredNotes writeRestoredGmsh(RestoredMesh& mesh, const std::filesystem::path& path);
/**
 * TetGen, two files beside each other, whichever of them is named: .node with attributes and
 * markers, .ele with attributes. Tetrahedra or triangles; polygons become triangles.
 */
RestoredNotes writeRestoredTetGen(RestoredMesh& mesh, const std::filesystem::path& path);

} // namespace smg
