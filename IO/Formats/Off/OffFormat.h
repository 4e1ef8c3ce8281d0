// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

extern const Format OffFormat;

} // namespace smg
