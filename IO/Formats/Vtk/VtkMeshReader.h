// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Raw/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

namespace smg
{

/**
 * Gives the mesh whose layout is known to the builder: points, cells, and the arrays that all
 * pieces have as columns. Of several pieces, those cells are left out that another piece has too
 * (`vtkGhostType`), and points with the same global number become one.
 * @param file the only file of the layout, or the one that names the files
 * @param progress where there are several files; else `file` tells it
 * @throws Error with the place in a file; Cancelled
 */
SMG_EXPORT void readVtkMesh(InputFile& file, const VtkLayout& layout, RawMeshBuilder& builder,
  const ProgressFunction& progress = {});

} // namespace smg
