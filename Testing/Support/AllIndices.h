// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace smg::testing
{

/** The index of all rows or columns of a matrix, whose name differs between Eigen 3.4 and 5. */
inline const Eigen::placeholders::all_t AllIndices;

} // namespace smg::testing
