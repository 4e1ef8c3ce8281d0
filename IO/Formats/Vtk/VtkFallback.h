// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkImporter.h"
#include "IO/Formats/Vtk/VtkLayout.h"

namespace smg
{

/** Whether an array of the layout is compressed in a way that only VTK reads. */
bool needsVtk(const VtkLayout& layout);

/**
 * Has a file of that layout read by VTK, in memory. Throws Error if there is no VtkImporter, or the
 * mesh takes more memory than the builder's workspace has; and as the importer.
 */
void importWithVtk(InputFile& file, VtkXmlKind kind, const VtkLayout& layout,
  RawMeshBuilder& builder, const ProgressFunction& progress);

} // namespace smg
