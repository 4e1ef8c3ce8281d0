// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <cstdint>

namespace smg
{

/**
 * Brings the vertices of a mesh into clusters by their edges alone: where coordinates say nothing
 * of neighbourhood. Some vertices, by their hash, become centres, the others join one next to them;
 * the mesh of the clusters is treated in the same way, round after round. Out of core.
 *
 * @returns for each vertex of the mesh a number: close numbers are mostly close in the mesh, and a
 * cluster of any round has numbers of its own, which follow each other. NoIndex: in no cell
 */
RecordFile<std::uint32_t> clusterNumbers(const RawMesh& mesh, Workspace& workspace);

} // namespace smg
