// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMeshBuilder.h"
#include "smg/Export.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Whether cells of VTK's type `type` are points or lines, which have no triangles. */
bool isPointOrLine(int type);

/** Whether cells of VTK's type `type` are solid, and have tetrahedra. */
SMG_EXPORT bool isSolidOfVtk(int type);

/** Passes a cell of VTK's type `type` to the builder, by its corners, without other points. Throws
 * MeshError if the type is not supported, or the cell has too few points for it. */
void takeVtkCell(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder);

} // namespace smg
