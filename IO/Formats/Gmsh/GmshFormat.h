// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Gmsh .msh 2.2 and 4.1, text and binary, elements of any order. */
extern const Format GmshFormat;

void importGmsh(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
