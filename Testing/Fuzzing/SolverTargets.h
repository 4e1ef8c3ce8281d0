// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <string_view>

namespace smg::testing
{

// Targets whose bytes reach a solve, as FuzzTarget::run. A solve has two V-cycles, small levels on
// disk and the least memory.

/** A problem file, on a mesh with columns of every kind. */
bool runProblem(std::string_view bytes, CellChoice cells);

/** A handle file, on the same meshes. */
bool runHandles(std::string_view bytes, CellChoice cells);

/** A list of places, from which distances are computed on the same meshes. */
bool runPlaces(std::string_view bytes, CellChoice cells);

/** A stream file or, with right checksums, a .vsm file, which is solved on, and of which previews
 * and distances are computed. */
bool runSolve(std::string_view bytes, CellChoice cells);

/** The state of a solve that was killed, edited by the bytes (see EditedState), with right
 * checksums. Accepted: the solve continues. */
bool runCheckpoint(std::string_view bytes, CellChoice cells);

} // namespace smg::testing
