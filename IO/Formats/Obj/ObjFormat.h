// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** OBJ: `v` and `f` lines; references to textures and normals, and everything else, are ignored. */
extern const Format ObjFormat;

} // namespace smg
