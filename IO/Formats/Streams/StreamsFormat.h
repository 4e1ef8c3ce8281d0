// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** The streaming formats SMA, SMB, SVA and SVB; see StreamFile.h. */
extern const Format StreamsFormat;

} // namespace smg
