// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Conversion.h"

namespace smg
{

/** Sorts a mesh into a stream order with scratch files and writes it. Throws like convert(). */
void convertMesh(Conversion& conversion);

} // namespace smg
