// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMesh.h"

namespace smg
{

/** Throws Error unless weldPoints() takes this tolerance. */
void checkWeldDistance(double tolerance);

/**
 * Merges points that lie at the same place: cells name the first one of them, the others are left
 * without cells. Points are taken in ascending order of x (then y, z, number); each is merged with
 * the first earlier one that is left within `tolerance` of it, if there is one.
 * @param tolerance largest distance, in units of the coordinates, at least 0: equal coordinates
 * @return the number of points that were merged
 * @throws Error if the tolerance is negative or no number, or more points lie within the tolerance
 * along x than the memory holds; Cancelled
 */
std::int64_t weldPoints(RawMesh& mesh, double tolerance, Workspace& workspace);

} // namespace smg
