// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/Suffix.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/TetGen/TetGenFormat.h"
#include "IO/Mesh/AttributeNames.h"

#include <limits>

namespace smg
{

namespace
{

constexpr int AnyNumber = std::numeric_limits<int>::max();

int components(const std::vector<ColumnSpec>& specs, std::ptrdiff_t column)
{
  return column < 0 ? 0 : specs[static_cast<std::size_t>(column)].components;
}

void writeNodes(TextOutput& out, RestoredMesh& mesh, PlacedColumns& columns)
{
  const RestoredInfo& info = mesh.info();
  const std::ptrdiff_t attributes = columns.ofVertices(AttributeName, 1, AnyNumber);
  const std::ptrdiff_t markers = columns.integerOfVertices({ MarkerName, ReferenceName });
  out << info.vertices << " 3 " << components(info.vertexColumns, attributes) << ' '
      << components(info.vertexColumns, markers) << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < static_cast<std::size_t>(vertices.count()); ++i)
    {
      out << vertices.first + static_cast<std::int64_t>(i) + 1 << ' ';
      out.position(positions.subspan(3 * i, 3), info.doublePositions);
      out.tuple(vertices.columns, attributes, i);
      out.tuple(vertices.columns, markers, i);
      out << '\n';
    }
  }
}

/** Tetrahedra, or polygons as triangles. */
void writeElements(TextOutput& out, RestoredMesh& mesh, PlacedColumns& columns)
{
  const RestoredInfo& info = mesh.info();
  std::ptrdiff_t attributes = columns.ofElements(AttributeName, 1, AnyNumber);
  if (attributes < 0)
  {
    attributes = columns.integerOfElements({ ReferenceName, PhysicalTagName });
  }
  out << info.cells << ' ' << cornersOf(info.cellType) << ' '
      << components(info.elementColumns, attributes) << '\n';
  std::int64_t number = 0;
  for (RestoredElements elements; mesh.next(elements);)
  {
    const auto write = [&](std::size_t element, std::span<const std::int64_t> corners)
    {
      out << ++number;
      for (const std::int64_t corner : corners)
      {
        out << ' ' << corner + 1;
      }
      out.tuple(elements.columns, attributes, element);
      out << '\n';
    };
    elements.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        info.cellType == CellType::Triangle
          ? forEachFanTriangle(corners, [&](const auto& triangle) { write(element, triangle); })
          : write(element, corners);
      });
  }
}

} // namespace

WriteNotes writeRestoredTetGen(RestoredMesh& mesh, const std::filesystem::path& path)
{
  PlacedColumns columns(mesh.info());
  const bool namesNodes = lowerSuffix(path) == ".node";
  const auto beside = [&path](const char* suffix)
  { return std::filesystem::path(path).replace_extension(suffix); };
  TextOutput nodes(namesNodes ? path : beside(".node"));
  TextOutput elements(namesNodes ? beside(".ele") : path);
  writeNodes(nodes, mesh, columns);
  writeElements(elements, mesh, columns);
  // Neither is renamed before both are on the disk.
  nodes.write();
  elements.write();
  nodes.finish();
  elements.finish();
  WriteNotes notes = columns.leftOut(".node and .ele");
  if (mesh.info().cellType == CellType::Triangle && mesh.info().mostCorners > 3)
  {
    notes.emplace_back("Polygons are written as triangles.");
  }
  return notes;
}

std::int64_t bytesOfTetGen(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const double attributes =
    tupleCharacters(mesh.vertexColumns, columns.ofVertices(AttributeName, 1, AnyNumber)) +
    tupleCharacters(mesh.vertexColumns, columns.integerOfVertices({ MarkerName, ReferenceName }));
  std::ptrdiff_t ofCells = columns.ofElements(AttributeName, 1, AnyNumber);
  ofCells = ofCells < 0 ? columns.integerOfElements({ ReferenceName, PhysicalTagName }) : ofCells;
  return textBytes(mesh.vertices, numberCharacters(mesh.vertices) +
                                    positionCharacters(mesh.doublePositions) + attributes) +
         textBytes(mesh.cells, numberCharacters(mesh.cells) +
                                 cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells));
}

} // namespace smg
