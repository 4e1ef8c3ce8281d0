// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkOrdinaryMesh_h
#define vtkOrdinaryMesh_h

#include "smg/Convert.h"

#include <filesystem>

class vtkDataObject;
class vtkPointSet;

namespace smg
{

/** Whether it is a mesh of any other source, not a piece of a mesh stream: no point has an id. */
bool isOrdinaryMesh(vtkDataObject& data);

/**
 * Writes a mesh that is whole in memory, with its arrays: convert() of a file in the scratch folder
 * that VTK writes of it. Throws as that, and Error if VTK cannot write it.
 */
ConversionReport writeOrdinaryMesh(
  vtkPointSet& mesh, const std::filesystem::path& path, const ConversionOptions& options);

} // namespace smg

#endif
