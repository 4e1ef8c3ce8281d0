// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** The container of this library. */
extern const Format VsmFileFormat;

} // namespace smg
