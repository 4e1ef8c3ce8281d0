// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/Conversion.h"

namespace smg
{

/** Brings a mesh into a new order, by scratch files, and writes it. Throws as convert(). */
void convertMesh(Conversion& conversion);

} // namespace smg
