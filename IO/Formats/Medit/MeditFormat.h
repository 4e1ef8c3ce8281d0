// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Medit .mesh as text. */
extern const Format MeditFormat;

void importMedit(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
