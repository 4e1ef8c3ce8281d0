// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"

namespace smg
{

/**
 * Finds out where everything stands in a legacy VTK file of polygonal data or of an unstructured
 * grid, text or binary, versions 1 to 5, without keeping any of it. Arrays of texts and bits are
 * left out.
 * @throws Error with the byte where the file is wrong or ends too early, or has another kind of
 * data
 */
VtkLayout legacyVtkLayout(InputFile& file);

} // namespace smg
