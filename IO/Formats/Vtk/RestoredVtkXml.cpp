// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkXmlFile.h"
#include "IO/Restore/RestoredMesh.h"

namespace smg
{

namespace
{

std::uint8_t kindOf(std::uint32_t corners, CellType cellType)
{
  if (cellType == CellType::Tetrahedron)
  {
    return VtkXmlFile::Tetrahedron;
  }
  return corners == 3   ? VtkXmlFile::Triangle
         : corners == 4 ? VtkXmlFile::Quadrilateral
                        : VtkXmlFile::Polygon;
}

} // namespace

WriteNotes writeRestoredVtkXml(RestoredMesh& mesh, const std::filesystem::path& path)
{
  const RestoredInfo& info = mesh.info();
  VtkXmlFile file(path, { info.doublePositions, info.vertices, info.elements, info.corners,
                          info.vertexColumns, info.elementColumns });
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    file.appendPoints(vertices.positions, vertices.columns);
  }
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> kinds;
  std::int64_t end = 0;
  for (RestoredElements elements; mesh.next(elements);)
  {
    ends.clear();
    kinds.clear();
    for (const std::uint32_t size : elements.sizes)
    {
      ends.push_back(end += size);
      kinds.push_back(kindOf(size, info.cellType));
    }
    file.appendCells(elements.corners, ends, kinds, elements.columns);
  }
  file.finish();
  return {};
}

} // namespace smg
