// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Formats.h"
#include "IO/Import/LegacyVtkLayout.h"
#include "IO/Import/VtkMeshReader.h"

namespace smg
{

void importLegacyVtk(InputFile& file, RawMeshBuilder& builder)
{
  readVtkMesh(file, legacyVtkLayout(file), builder);
}

} // namespace smg
