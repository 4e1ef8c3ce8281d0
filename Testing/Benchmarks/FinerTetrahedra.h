// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

namespace smg::benchmark
{

/**
 * The mesh with every tetrahedron split in eight at the midpoints of its edges: four at its corners
 * and four around the shortest diagonal of the octahedron between them. Orientation is kept.
 */
testing::IndexedTestMesh finerTetrahedra(const testing::IndexedTestMesh& tetrahedra);

} // namespace smg::benchmark
