// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"
#include "IO/Import/MemoryBudget.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/** What an importer may use and whom it tells. */
struct ImportOptions
{
  MemoryBudget budget;
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
  VtkLegacy,
  VtkXml
};

/** The format by the file's first bytes; Unknown where these say nothing, as for STL and OBJ. */
MeshFormat meshFormatOfContent(const std::filesystem::path& path);

/** The format by the file's first bytes, or by its suffix where these say nothing. */
MeshFormat meshFormat(const std::filesystem::path& path);

/** Reads the VTK formats. */
using VtkImporter = IndexedMesh (*)(
  const std::filesystem::path& path, MeshFormat format, const ImportOptions& options);

/**
 * Sets who reads the VTK formats, since this library knows nothing of VTK: IO/vtkMeshImport.h has
 * the function. Until it is set, these formats are refused.
 */
void setVtkImporter(VtkImporter importer);

/**
 * Reads a mesh from a PLY, OBJ, OFF, STL, Medit or Gmsh file, or from a VTK file (see
 * setVtkImporter). The mesh has at least one cell, and no column with a reserved name
 * (ReservedNames.h): such columns are left out and named.
 * @throws Error naming the file and the line, record or byte: the format is not known, the file is
 * empty, truncated or contradicts itself, a coordinate is not finite, a corner is no vertex, there
 * are no cells, or the conversion would exceed the memory budget; Cancelled.
 */
IndexedMesh importMesh(const std::filesystem::path& path, const ImportOptions& options = {});

} // namespace smg
