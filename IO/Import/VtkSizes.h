// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/Importer.h"

#include <filesystem>

namespace smg
{

enum class VtkDataKind
{
  PolyData,
  UnstructuredGrid,
  Other
};

/** What a VTK file says of itself. */
struct VtkSizes
{
  VtkDataKind kind = VtkDataKind::Other;
  /** Counts over all pieces, with what VTK's own data set takes counted as attributes. */
  MeshSizes mesh;
  /** Whether the file has <AppendedData>, which not every version of VTK and Expat reads. */
  bool appendedData = false;
};

/**
 * Looks up the kind and the counts of a legacy or XML file without reading it, so that neither a
 * mesh that is too large nor a wrong count gets as far as VTK's readers.
 * @throws Error if a count is more than the file can hold
 */
VtkSizes vtkSizes(const std::filesystem::path& path, MeshFormat format);

} // namespace smg
