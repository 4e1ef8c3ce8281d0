// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoredMesh.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkXmlFile.h"
#include "IO/Mesh/RowBytes.h"

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

std::int64_t bytesOfVtkXml(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  const std::int64_t typeBytes = written.suffix.text == ".vtp" ? 0 : 1;
  const std::int64_t numbers = cornersOf(mesh.cellType) + 1;
  const std::int64_t bytes =
    mesh.vertices * rowBytes(mesh.vertexColumns, positionBytes(mesh)) +
    mesh.cells *
      rowBytes(mesh.cellColumns, numbers * std::int64_t(sizeof(std::int64_t)) + typeBytes);
  return bytes / 3 * 4; // base64
}

} // namespace smg
