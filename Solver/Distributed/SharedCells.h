// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"

#include <cstdint>

namespace smg
{

/** The number of cells, by their vertices, that several processes have. Called on all processes. */
std::int64_t repeatedCells(const SharedVertices& vertices, const MeshPart& part);

} // namespace smg
