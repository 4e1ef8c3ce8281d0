// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

extern const Format MeditFormat;
extern const Format BinaryMeditFormat;

void importMedit(InputFile& file, RawMeshBuilder& builder);
void importBinaryMedit(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
