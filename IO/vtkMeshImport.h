// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkMeshImport_h
#define vtkMeshImport_h

#include "IO/Import/Importer.h"
#include "vtkStreamingMultigridIOModule.h"

#include <filesystem>

namespace smg
{

/**
 * Reads a legacy VTK file or a .vtp or .vtu file with VTK's own readers. Polygons, strips, quads
 * and pixels become triangles; second-order cells lose their middle points; points and lines, and
 * all faces beside tetrahedra, are left out; numeric point and cell arrays become columns.
 * @throws Error if VTK's reader complains, the file is neither vtkPolyData nor vtkUnstructuredGrid,
 * or has volume cells that are no tetrahedra; and as importMesh()
 */
VTKSTREAMINGMULTIGRIDIO_EXPORT IndexedMesh importVtkMesh(
  const std::filesystem::path& path, MeshFormat format, const ImportOptions& options);

/** Makes importMesh() read the VTK formats. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void registerVtkImporter();

} // namespace smg

#endif
