// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Obj/ObjFormat.h"
#include "IO/Mesh/AttributeNames.h"

namespace smg
{

namespace
{

/** Writes a colour, from 0 to 1. */
void writeColor(TextOutput& out, const Column& colors, std::size_t tuple)
{
  const double one = colors.spec.type == ScalarType::UInt8 ? 255.0 : 1.0;
  for (int k = 0; k < colors.spec.components; ++k)
  {
    out << ' ' << static_cast<float>(colors.value(tuple, k) / one);
  }
}

} // namespace

WriteNotes writeRestoredObj(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const bool isDouble = mesh.info().doublePositions;
  PlacedColumns columns(mesh.info());
  const std::ptrdiff_t colors = columns.ofVertices(ColorsName, 3, 4);
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out << "v ";
      out.position(positions.subspan(i, 3), isDouble);
      if (colors >= 0)
      {
        writeColor(out, vertices.columns[static_cast<std::size_t>(colors)], i / 3);
      }
      out << '\n';
    }
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    elements.forEach(
      [&out](std::span<const std::int64_t> corners, std::size_t)
      {
        out << 'f';
        for (const std::int64_t corner : corners)
        {
          out << ' ' << corner + 1;
        }
        out << '\n';
      });
  }
  out.finish();
  return columns.leftOut(".obj");
}

std::int64_t bytesOfObj(const MeshToWrite& written)
{
  constexpr double Keyword = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const std::ptrdiff_t colors = columns.ofVertices(ColorsName, 3, 4);
  const double colorCharacters =
    colors < 0 ? 0 : realCharacters(false) * mesh.vertexColumns[std::size_t(colors)].components;
  return textBytes(
           mesh.vertices, Keyword + positionCharacters(mesh.doublePositions) + colorCharacters) +
         textBytes(mesh.cells, Keyword + 3 * numberCharacters(mesh.vertices));
}

} // namespace smg
