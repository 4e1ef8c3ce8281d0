// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <cstdint>

namespace smg
{

/**
 * Groups the vertices of a mesh into clusters by their edges alone, where coordinates tell nothing
 * about neighbourhood. Some vertices, chosen by a hash, become centres, the others join one next to
 * them; the mesh of the clusters is treated in the same way, round after round. Out of core.
 *
 * @returns a number for each vertex of the mesh, by which vertices with close numbers are mostly
 * close in the mesh, and each cluster of any round has consecutive numbers; NoIndex for a vertex of
 * no cell
 */
RecordFile<std::uint32_t> clusterNumbers(const RawMesh& mesh, Workspace& workspace);

} // namespace smg
