// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Conversion.h"

namespace smg
{

/** Writes a stream in its order, block by block, with the flags of its degenerate and duplicate
 * cells. Throws like convert(). */
void copyStream(Conversion& conversion);

} // namespace smg
