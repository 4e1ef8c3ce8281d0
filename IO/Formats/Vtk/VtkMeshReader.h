// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

namespace smg
{

/**
 * Passes the mesh with a known layout to the builder: points, cells, and as columns the arrays that
 * all pieces have. Of several pieces, cells that belong to another piece (`vtkGhostType`) are
 * omitted, and points with the same global number are merged.
 * @param file the only file of the layout, or the one that names the files
 * @param progress of several files; otherwise `file` reports it
 * @throws Error with the position in a file; Cancelled
 */
SMG_EXPORT void readVtkMesh(InputFile& file, const VtkLayout& layout, RawMeshBuilder& builder,
  const ProgressFunction& progress = {});

} // namespace smg
