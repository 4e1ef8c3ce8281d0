// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/ReservedNames.h"

namespace smg
{

/** Field arrays of data that is a preview: 1, and the counts of the mesh that it stands for. */
inline constexpr const char* PreviewName = "Preview";
inline constexpr const char* FullNumberOfPointsName = "FullNumberOfPoints";
inline constexpr const char* FullNumberOfCellsName = "FullNumberOfCells";

/** And of a preview that a reader shows: who pulls its pieces gets the mesh itself. By the number
 * of its components, which arrays do not have by chance, ParaView finds the writer that does. */
inline constexpr const char* PreviewOfReaderName = "PreviewOfReader";
inline constexpr int PreviewOfReaderComponents = 17;

} // namespace smg
