// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkMeshImport_h
#define vtkMeshImport_h

#include "IO/AnyFormat/Importer.h"
#include "vtkStreamingMultigridIOModule.h"

#include <filesystem>

namespace smg
{

/**
 * Reads a .vtp or .vtu file with VTK's own reader, in memory, and writes it with appended raw data
 * and without compression, as which it is parsed as a stream. It is a VtkRecoder.
 * @throws Error if VTK's reader or writer complains
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT void recodeVtkFile(
  const std::filesystem::path& from, const std::filesystem::path& to);

/** Makes importMesh() have VTK read what it cannot parse itself. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void registerVtkImporter();

} // namespace smg

#endif
