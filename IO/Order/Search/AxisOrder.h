// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/VertexPages.h"

namespace smg
{

/** The vertices along the longest side of their bounds; ties by their numbers in the file. */
OrderedVertices axisOrder(VertexPages& pages, Workspace& workspace);

} // namespace smg
