// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Off/OffFormat.h"
#include "IO/Mesh/AttributeNames.h"

#include <cmath>

namespace smg
{

namespace
{

/** Writes a colour; numbers from 0 to 1 with a decimal point, since those without are bytes. */
void writeColor(
  TextOutput& out, const std::vector<Column>& columns, std::ptrdiff_t column, std::size_t tuple)
{
  if (column < 0 || columns[static_cast<std::size_t>(column)].spec.type == ScalarType::UInt8)
  {
    out.tuple(columns, column, tuple);
    return;
  }
  const Column& colors = columns[static_cast<std::size_t>(column)];
  for (int k = 0; k < colors.spec.components; ++k)
  {
    const auto value = static_cast<float>(colors.value(tuple, k));
    out << ' ' << value << (value == std::floor(value) ? ".0" : "");
  }
}

} // namespace

WriteNotes writeRestoredOff(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  PlacedColumns columns(info);
  const std::ptrdiff_t normals = columns.ofVertices(NormalsName, 3, 3);
  const std::ptrdiff_t colors = columns.ofVertices(ColorsName, 3, 4);
  const std::ptrdiff_t texture = columns.ofVertices(TextureCoordinatesName, 2, 2);
  const std::ptrdiff_t faceColors = columns.ofElements(ColorsName, 3, 4);
  out << (texture < 0 ? "" : "ST") << (colors < 0 ? "" : "C") << (normals < 0 ? "" : "N");
  out << "OFF\n" << info.vertices << ' ' << info.elements << " 0\n";
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out.position(positions.subspan(i, 3), info.doublePositions);
      out.tuple(vertices.columns, normals, i / 3);
      writeColor(out, vertices.columns, colors, i / 3);
      out.tuple(vertices.columns, texture, i / 3);
      out << '\n';
    }
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    elements.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        out << corners.size();
        for (const std::int64_t corner : corners)
        {
          out << ' ' << corner;
        }
        writeColor(out, elements.columns, faceColors, element);
        out << '\n';
      });
  }
  out.finish();
  return columns.leftOut(".off");
}

std::int64_t bytesOfOff(const MeshToWrite& written)
{
  constexpr double CountOfCorners = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  double ofVertices = positionCharacters(mesh.doublePositions);
  for (const std::ptrdiff_t column : { columns.ofVertices(NormalsName, 3, 3),
         columns.ofVertices(ColorsName, 3, 4), columns.ofVertices(TextureCoordinatesName, 2, 2) })
  {
    ofVertices += tupleCharacters(mesh.vertexColumns, column);
  }
  const std::ptrdiff_t faceColors = columns.ofElements(ColorsName, 3, 4);
  return textBytes(mesh.vertices, ofVertices) +
         textBytes(mesh.cells, CountOfCorners + 3 * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, faceColors));
}

} // namespace smg
