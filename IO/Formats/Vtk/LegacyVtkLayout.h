// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"

namespace smg
{

/**
 * Finds the positions of all data in a legacy VTK file of polygonal data or of an unstructured
 * grid, text or binary, versions 1 to 5, without storing the data. Arrays of texts and bits are
 * omitted.
 * @throws Error with the byte position if the file is invalid, truncated, or has another kind of
 * data
 */
VtkLayout legacyVtkLayout(InputFile& file);

} // namespace smg
