// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace smg
{

/** Point array, uint8: 1 where no later piece uses the point. */
inline constexpr const char* StreamFinalizedName = "StreamFinalized";
/** Point GlobalIds: stream indices. */
inline constexpr const char* GlobalIdsName = "GlobalIds";
/** Point array, uint8, of VTK: DUPLICATEPOINT where an earlier piece owns the point. */
inline constexpr const char* GhostTypeName = "vtkGhostType";

/** Field arrays of data that is a preview: 1, and the counts of the mesh that it stands for. */
inline constexpr const char* PreviewName = "Preview";
inline constexpr const char* FullNumberOfPointsName = "FullNumberOfPoints";
inline constexpr const char* FullNumberOfCellsName = "FullNumberOfCells";

/** Whether an array of this name belongs to the piece contract, not to the mesh. */
constexpr bool isContractArray(std::string_view name)
{
  return name == StreamFinalizedName || name == GlobalIdsName || name == GhostTypeName;
}

} // namespace smg
