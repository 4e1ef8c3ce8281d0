// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/** How to read a mesh. */
struct ImportOptions
{
  CellChoice cells = CellChoice::Only;
  ProgressFunction progress;
};

/** The file formats of indexed meshes. */
enum class MeshFormat
{
  Unknown,
  Ply,
  Obj,
  Off,
  Stl,
  Medit,
  Gmsh,
  TetGen,
  VtkLegacy,
  VtkXml,
  VtkParallelXml
};

/**
 * The format by the sign that the file begins with; Unknown for what has none, as STL, OBJ and
 * TetGen. Of a file that gzip compressed, it is the format of what it holds.
 */
MeshFormat meshFormatOfContent(const std::filesystem::path& path);

/**
 * The format by the sign that the file begins with, else by its first bytes if they look like STL
 * or OBJ, else by its suffix, .gz left out of account.
 */
MeshFormat meshFormat(const std::filesystem::path& path);

/**
 * Reads a VTK file with VTK's own readers, in memory, for what is not parsed as a stream. Gives the
 * mesh to the builder.
 */
using VtkImporter = void (*)(const std::filesystem::path& path, MeshFormat format,
  RawMeshBuilder& builder, const ProgressFunction& progress);

/**
 * Sets who reads the VTK files that are not parsed as streams (compressed by LZMA), since
 * this library knows nothing of VTK: IO/vtkMeshImport.h has the function. Until it is set, such
 * files are refused.
 */
void setVtkImporter(VtkImporter importer);
VtkImporter vtkImporter();

/**
 * Parses a mesh file of any format: PLY, OBJ, OFF, STL, Medit, Gmsh, TetGen, legacy VTK, VTK XML,
 * or one of them compressed by gzip. The format is told by the content, by the suffix only where
 * the content says nothing.
 * @throws Error naming the file and the line, record or byte: the format is not known, the file is
 * empty, truncated or contradicts itself, a coordinate is not finite, a corner is no vertex, there
 * are no cells, or both triangles and tetrahedra; Cancelled.
 */
RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options = {});

} // namespace smg
