// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

extern const Format GmshFormat;

void importGmsh(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
