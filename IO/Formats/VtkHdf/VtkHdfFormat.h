// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Format.h"

namespace smg
{

/**
 * VTKHDF: unstructured grids and polygonal data, any number of partitions, of several time steps
 * the first. Partitions whose points have global numbers become one mesh, without duplicate cells.
 * Written is an unstructured grid of version 1.0, which every reader since VTK 9.1 knows.
 */
extern const Format VtkHdfFormat;

} // namespace smg
