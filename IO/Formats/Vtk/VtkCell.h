// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "smg/Export.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Whether cells of VTK's type `type` are points or lines, which have no triangles. */
bool isPointOrLine(int type);

/** Whether cells of VTK's type `type` are solid, and have tetrahedra. */
SMG_EXPORT bool isSolidOfVtk(int type);

/** About the triangles or tetrahedra of a cell of VTK's type `type` with so many points; of a
 * hexahedron six, though five may do. */
SMG_EXPORT std::int64_t partsOfVtk(int type, std::int64_t points);

/** Passes a cell of VTK's type `type` to the builder, by its corners, without other points. Throws
 * MeshError if the type is not supported, or the cell has too few points for it. */
void takeVtkCell(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder);

} // namespace smg
