// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Gmsh/GmshFormat.h"
#include "IO/Mesh/AttributeNames.h"

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

/** Numbers elements from 1 and writes them with their tags. */
class GmshElements
{
public:
  GmshElements(TextOutput& out, CellType cellType, PlacedColumns& columns)
    : Out(out)
    , CellKind(cellType)
    , Group(columns.integerOfElements({ PhysicalTagName, ReferenceName }))
    , Entity(columns.integerOfElements({ GeometricalTagName }))
  {
  }

  void write(const RestoredElements& elements)
  {
    elements.forEach([&](std::span<const std::int64_t> corners, std::size_t element)
      { this->write(elements, element, corners); });
  }

private:
  void write(
    const RestoredElements& elements, std::size_t element, std::span<const std::int64_t> corners)
  {
    if (this->CellKind == CellType::Tetrahedron)
    {
      this->write(elements, element, GmshTetrahedron, corners);
    }
    else if (corners.size() == 4)
    {
      this->write(elements, element, GmshQuadrilateral, corners);
    }
    else
    {
      forEachFanTriangle(corners,
        [&](const auto& triangle) { this->write(elements, element, GmshTriangle, triangle); });
    }
  }

  void write(const RestoredElements& elements, std::size_t element, GmshType type,
    std::span<const std::int64_t> corners)
  {
    // Two tags, which Gmsh requires.
    this->Out << ++this->Count << ' ' << static_cast<int>(type) << " 2";
    this->Out.tuple(elements.columns, this->Group, element, " 0");
    this->Out.tuple(elements.columns, this->Entity, element, " 1");
    for (const std::int64_t corner : corners)
    {
      this->Out << ' ' << corner + 1;
    }
    this->Out << '\n';
  }

  TextOutput& Out;
  CellType CellKind;
  std::ptrdiff_t Group, Entity; ///< columns
  std::int64_t Count = 0;
};

} // namespace

WriteNotes writeRestoredGmsh(RestoredMesh& mesh, const std::filesystem::path& path)
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
  // All cells of the stream, except for one of the two triangles of each quadrilateral.
  out << "$EndNodes\n$Elements\n" << info.cells - info.quadrilaterals << '\n';
  PlacedColumns columns(info);
  GmshElements writer(out, info.cellType, columns);
  for (RestoredElements elements; mesh.next(elements);)
  {
    writer.write(elements);
  }
  out << "$EndElements\n";
  out.finish();
  WriteNotes notes = columns.leftOut(".msh");
  if (info.cellType == CellType::Triangle && info.mostCorners > 4)
  {
    notes.emplace_back("Polygons of more than four corners are written as triangles.");
  }
  return notes;
}

std::int64_t bytesOfGmsh(const MeshToWrite& written)
{
  constexpr double TypeAndTags = 8; // as "4 2 0 1 "
  const StreamInfo& mesh = written.mesh;
  return textBytes(mesh.vertices,
           numberCharacters(mesh.vertices) + positionCharacters(mesh.doublePositions)) +
         textBytes(mesh.cells, numberCharacters(mesh.cells) + TypeAndTags +
                                 cornersOf(mesh.cellType) * numberCharacters(mesh.vertices));
}

} // namespace smg
