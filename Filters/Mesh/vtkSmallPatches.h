// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Of each point of a surface: whether it is of a small patch, of at most 64 points, of those that
 * masks of handles, conditions and regions mark (unsigned char arrays of one component): these
 * could vanish in a coarser mesh. */
std::vector<std::uint8_t> smallPatches(vtkPointSet& surface);

} // namespace smg
