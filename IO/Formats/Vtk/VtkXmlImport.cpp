// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/VtkFallback.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Raw/RawMeshBuilder.h"

namespace smg
{

void importVtkXml(InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  VtkLayout layout;
  addVtkXmlLayout(file, layout, builder.workspace().available() / 2);
  if (needsVtk(layout))
  {
    importWithVtk(file, VtkXmlKind::Whole, layout, builder, progress);
    return;
  }
  readVtkMesh(file, layout, builder);
}

} // namespace smg
