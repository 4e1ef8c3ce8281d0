// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Medit .mesh as text. */
extern const Format MeditFormat;
/** Medit .meshb, binary, which is only read. */
extern const Format BinaryMeditFormat;

void importMedit(InputFile& file, RawMeshBuilder& builder);
void importBinaryMedit(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
