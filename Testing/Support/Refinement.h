// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

namespace smg::testing
{

/** The mesh with every triangle split into four at the midpoints of its edges. */
IndexedTestMesh refined(const IndexedTestMesh& triangles);

} // namespace smg::testing
