// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/ReservedNames.h"

namespace smg
{

/** Field arrays of a preview: 1, and the counts of the mesh that it represents. */
inline constexpr const char* PreviewName = "Preview";
inline constexpr const char* FullNumberOfPointsName = "FullNumberOfPoints";
inline constexpr const char* FullNumberOfCellsName = "FullNumberOfCells";

/** Field array of a preview of a reader, for which streamed requests return the mesh itself.
 * ParaView selects the writer by its unusual number of components. */
inline constexpr const char* PreviewOfReaderName = "PreviewOfReader";
inline constexpr int PreviewOfReaderComponents = 17;

} // namespace smg
