// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/InputFile.h"

#include <cstdint>

namespace smg
{

/**
 * Walks through the lists of cells of a legacy VTK file and answers the number of cells. Up to
 * version 4 of the format every cell is led by its number of points, which VTK's readers believe:
 * a wrong one would have them read beyond the end of the list.
 * @throws Error naming the byte where a list is wrong or truncated
 */
std::int64_t checkLegacyVtkCells(const InputFile& file);

} // namespace smg
