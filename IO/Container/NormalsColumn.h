// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Stream/Column.h"

namespace smg
{

/** Name of the column of 3 components that holds normals, of vertices or of cells. */
inline constexpr const char* NormalsName = "Normals";

/** Whether a column holds normals, in whatever type. */
inline bool isNormals(const ColumnSpec& spec)
{
  return spec.name == NormalsName && spec.components == 3;
}

} // namespace smg
