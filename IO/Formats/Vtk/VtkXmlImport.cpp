// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Raw/RawMeshBuilder.h"

namespace smg
{

void importVtkXml(InputFile& file, RawMeshBuilder& builder)
{
  VtkLayout layout;
  addVtkXmlLayout(file, layout, builder.workspace().available() / 2);
  readVtkMesh(file, layout, builder);
}

} // namespace smg
