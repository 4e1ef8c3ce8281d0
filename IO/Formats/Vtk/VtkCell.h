// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMeshBuilder.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Whether cells of VTK's type `type` are points or lines, which make no triangles. */
bool isPointOrLine(int type);

/**
 * Gives a cell of VTK's type `type` to the builder, by its corners: what points it has beside them
 * is left out. Throws MeshError if the type is not read, or the cell has too few points for it.
 */
void takeVtkCell(int type, std::span<const std::int64_t> points, RawMeshBuilder& builder);

} // namespace smg
