// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>
#include <string_view>

namespace smg
{

/** About the most bytes of scratch files at once while RestoredMesh sorts the mesh of a .vsm file
 * in a workspace of `memory` bytes, and a file of this suffix is written of it. `mesh` has the
 * columns of that file. */
std::int64_t restoreBytes(const StreamInfo& mesh, std::int64_t memory, std::string_view suffix);

} // namespace smg
