// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Container/ReservedNames.h"

namespace smg
{

/** Field arrays of data that is a preview: 1, and the counts of the mesh that it stands for. */
inline constexpr const char* PreviewName = "Preview";
inline constexpr const char* FullNumberOfPointsName = "FullNumberOfPoints";
inline constexpr const char* FullNumberOfCellsName = "FullNumberOfCells";

} // namespace smg
