// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>

namespace smg::testing
{

/**
 * A surface as scanners give it: the gyroid, sampled n^3 times in the unit cube with noise up to
 * `noise`, by marching tetrahedra. A sample near the level gives vertices that nearly coincide, and
 * slivers beside them; noise gives small bodies. It is open at the cube.
 */
IndexedTestMesh noisyGyroid(int n, double noise, std::uint64_t seed = 1);

} // namespace smg::testing
