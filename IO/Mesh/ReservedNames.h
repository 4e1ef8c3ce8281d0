// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace smg
{

/** Point array, uint8: 1 where no later piece uses the point. */
inline constexpr const char* StreamFinalizedName = "StreamFinalized";
/** Point GlobalIds: stream indices. */
inline constexpr const char* GlobalIdsName = "GlobalIds";
/** Point array, uint8, of VTK: DUPLICATEPOINT where an earlier piece owns the point. */
inline constexpr const char* GhostTypeName = "vtkGhostType";

/** Whether an array of this name belongs to the piece contract, not to the mesh. */
constexpr bool isContractArray(std::string_view name)
{
  return name == StreamFinalizedName || name == GlobalIdsName || name == GhostTypeName;
}

/** Whether no attribute of a mesh can have this name: an array of the piece contract, or a table or
 * column of the container itself (VsmFormat.h). */
constexpr bool isReservedColumn(std::string_view name)
{
  constexpr std::array<std::string_view, 3> own{ "Position", "LastCell", "Corners" };
  return isContractArray(name) || std::find(own.begin(), own.end(), name) != own.end();
}

} // namespace smg
