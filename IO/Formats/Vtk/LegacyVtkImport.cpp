// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/LegacyVtkLayout.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Raw/RawMeshBuilder.h"

namespace smg
{

void importLegacyVtk(InputFile& file, RawMeshBuilder& builder)
{
  readVtkMesh(file, legacyVtkLayout(file), builder);
}

} // namespace smg
