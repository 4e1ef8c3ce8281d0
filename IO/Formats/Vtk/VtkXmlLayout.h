// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkLayout.h"

#include <cstdint>

namespace smg
{

/**
 * Finds out where everything stands in a .vtp or .vtu file and adds its pieces to the layout.
 * Arrays of texts and bits are left out.
 * @param mostBytes of memory that the layout may take
 * @throws Error with the byte where the file is wrong or ends too early, or has another kind of
 * data
 */
void addVtkXmlLayout(InputFile& file, VtkLayout& layout, std::int64_t mostBytes);

} // namespace smg
