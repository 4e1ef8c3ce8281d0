// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** OFF, text or binary, with or without colours, normals and texture coordinates. */
extern const Format OffFormat;

} // namespace smg
