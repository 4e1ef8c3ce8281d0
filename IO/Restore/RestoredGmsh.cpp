// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/RestoredFormats.h"
#include "IO/Restore/TextOutput.h"

namespace smg
{

namespace
{

/** Types of elements in Gmsh. */
enum GmshType
{
  GmshTriangle = 2,
  GmshQuadrilateral = 3,
  GmshTetrahedron = 4
};

/** Numbers elements from 1 and writes them. */
class GmshElements
{
public:
  GmshElements(TextOutput& out, CellType cellType)
    : Out(out)
    , CellKind(cellType)
  {
  }

  void write(std::span<const std::int64_t> corners)
  {
    if (this->CellKind == CellType::Tetrahedron)
    {
      this->write(GmshTetrahedron, corners);
    }
    else if (corners.size() == 4)
    {
      this->write(GmshQuadrilateral, corners);
    }
    else
    {
      for (std::size_t i = 2; i < corners.size(); ++i)
      {
        const std::int64_t triangle[] = { corners[0], corners[i - 1], corners[i] };
        this->write(GmshTriangle, triangle);
      }
    }
  }

private:
  void write(GmshType type, std::span<const std::int64_t> corners)
  {
    // Two tags, which Gmsh demands: no physical entity, elementary entity 1.
    this->Out << ++this->Count << ' ' << static_cast<int>(type) << " 2 0 1";
    for (const std::int64_t corner : corners)
    {
      this->Out << ' ' << corner + 1;
    }
    this->Out << '\n';
  }

  TextOutput& Out;
  CellType CellKind;
  std::int64_t Count = 0;
};

} // namespace

RestoredNotes writeRestoredGmsh(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << info.vertices << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::int64_t i = 0; i < vertices.count(); ++i)
    {
      out << vertices.first + i + 1 << ' ';
      out.position(positions.subspan(static_cast<std::size_t>(3 * i), 3), info.doublePositions);
      out << '\n';
    }
  }
  // All cells of the stream, but for one of the two triangles of each quadrilateral.
  out << "$EndNodes\n$Elements\n" << info.cells - info.quadrilaterals << '\n';
  GmshElements writer(out, info.cellType);
  for (RestoredElements elements; mesh.next(elements);)
  {
    elements.forEach([&writer](std::span<const std::int64_t> corners) { writer.write(corners); });
  }
  out << "$EndElements\n";
  out.finish();
  if (info.cellType == CellType::Triangle && info.mostCorners > 4)
  {
    return { "Polygons of more than four corners are written as triangles." };
  }
  return {};
}

} // namespace smg
