// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkXmlFile.h"
#include "IO/Restore/RestoredMesh.h"

namespace smg
{

WriteNotes writeRestoredVtkXml(RestoredMesh& mesh, const std::filesystem::path& path)
{
  const RestoredInfo& info = mesh.info();
  VtkXmlFile file(path, { info.cellType, info.doublePositions, info.vertices, info.elements,
                          info.corners, info.vertexColumns, info.elementColumns });
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    file.appendPoints(vertices.positions, vertices.columns);
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    file.appendCells(elements.corners, elements.sizes, elements.columns);
  }
  file.finish();
  return {};
}

} // namespace smg
