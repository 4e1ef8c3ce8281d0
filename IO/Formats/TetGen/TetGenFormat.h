// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** TetGen: the .node or the .ele file; the other one is in the same folder. */
extern const Format TetGenFormat;

void importTetGen(InputFile& file, RawMeshBuilder& builder);

} // namespace smg
