// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Formats.h"
#include "IO/Import/VtkFallback.h"
#include "IO/Import/VtkMeshReader.h"
#include "IO/Import/VtkXmlLayout.h"

namespace smg
{

void importVtkXml(InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  VtkLayout layout;
  addVtkXmlLayout(file, layout, builder.workspace().available() / 2);
  if (needsVtk(layout))
  {
    importWithVtk(file, MeshFormat::VtkXml, layout, builder, progress);
    return;
  }
  readVtkMesh(file, layout, builder);
}

} // namespace smg
