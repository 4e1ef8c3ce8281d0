// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace smg::testing
{

/** All rows or columns of a matrix, as an index of it: Eigen 3.4 and 5 call theirs differently. */
inline const Eigen::placeholders::all_t AllIndices;

} // namespace smg::testing
