// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/**
 * VTKHDF: unstructured grids and polygonal data, one of any number of time steps, all partitions or
 * one. Partitions whose points have global numbers become one mesh, without duplicate cells.
 * Writes an unstructured grid of version 1.0, which every reader since VTK 9.1 supports.
 */
extern const Format VtkHdfFormat;

} // namespace smg
