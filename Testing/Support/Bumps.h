// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>

namespace smg::testing
{

/**
 * The mesh of triangles with every vertex moved along its normal, by up to `amplitude` times the
 * mesh's mean edge length to either side.
 */
IndexedTestMesh bumpy(const IndexedTestMesh& triangles, double amplitude, std::uint64_t seed = 1);

} // namespace smg::testing
