// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"

#include <filesystem>

namespace smg
{

/** A file in a format of VTK's XML: one mesh, or one that names the files of its pieces. */
enum class VtkXmlKind
{
  Whole,
  InPieces
};

/**
 * Reads a VTK file with VTK's own readers, in memory, for what is not parsed as a stream. Gives the
 * mesh to the builder.
 */
using VtkImporter = void (*)(const std::filesystem::path& path, VtkXmlKind kind,
  RawMeshBuilder& builder, const ProgressFunction& progress);

/**
 * Sets who reads the VTK files that are not parsed as streams (compressed by LZMA), since
 * this library knows nothing of VTK: IO/vtkMeshImport.h has the function. Until it is set, such
 * files are refused.
 */
void setVtkImporter(VtkImporter importer);
VtkImporter vtkImporter();

} // namespace smg
