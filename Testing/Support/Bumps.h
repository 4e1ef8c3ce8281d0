// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>

namespace smg::testing
{

/** The triangle mesh with every vertex moved along its normal, by up to `amplitude` times the mean
 * edge length to either side. */
IndexedTestMesh bumpy(const IndexedTestMesh& triangles, double amplitude, std::uint64_t seed = 1);

} // namespace smg::testing
