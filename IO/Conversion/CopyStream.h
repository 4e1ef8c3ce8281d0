// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Conversion.h"

namespace smg
{

/**
 * Writes a mesh that is a stream in the order that it has, block by block, with the flags of its
 * degenerate and duplicate cells. Throws as convert().
 */
void copyStream(Conversion& conversion);

} // namespace smg
