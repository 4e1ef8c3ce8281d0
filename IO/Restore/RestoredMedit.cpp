// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/RestoredFormats.h"
#include "IO/Restore/TextOutput.h"

#include <array>

namespace smg
{

namespace
{

/** Writes an element by its corners, which count from 1, and a reference that says nothing. */
void writeElement(TextOutput& out, std::span<const std::int64_t> corners)
{
  for (const std::int64_t corner : corners)
  {
    out << corner + 1 << ' ';
  }
  out << "0\n";
}

void writePolygons(TextOutput& out, RestoredMesh& mesh)
{
  const RestoredInfo& info = mesh.info();
  // All triangles of the stream, but for the two of each quadrilateral.
  if (const std::int64_t triangles = info.cells - 2 * info.quadrilaterals; triangles > 0)
  {
    out << "Triangles\n" << triangles << '\n';
    for (RestoredElements elements; mesh.next(elements);)
    {
      elements.forEach(
        [&out](std::span<const std::int64_t> polygon)
        {
          for (std::size_t i = 2; i < polygon.size() && polygon.size() != 4; ++i)
          {
            writeElement(out, std::array{ polygon[0], polygon[i - 1], polygon[i] });
          }
        });
    }
    mesh.rewindElements();
  }
  if (info.quadrilaterals > 0)
  {
    out << "Quadrilaterals\n" << info.quadrilaterals << '\n';
    for (RestoredElements elements; mesh.next(elements);)
    {
      elements.forEach(
        [&out](std::span<const std::int64_t> polygon)
        {
          if (polygon.size() == 4)
          {
            writeElement(out, polygon);
          }
        });
    }
  }
}

} // namespace

RestoredNotes writeRestoredMedit(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  out << "MeshVersionFormatted " << (info.doublePositions ? 2 : 1) << "\nDimension 3\nVertices\n"
      << info.vertices << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out.position(positions.subspan(i, 3), info.doublePositions);
      out << " 0\n";
    }
  }
  if (info.cellType == CellType::Triangle)
  {
    writePolygons(out, mesh);
  }
  else
  {
    out << "Tetrahedra\n" << info.elements << '\n';
    for (RestoredElements elements; mesh.next(elements);)
    {
      elements.forEach(
        [&out](std::span<const std::int64_t> corners) { writeElement(out, corners); });
    }
  }
  out << "End\n";
  out.finish();
  RestoredNotes notes;
  if (info.quadrilaterals > 0 && info.quadrilaterals < info.elements)
  {
    notes.push_back("The quadrilaterals come after the triangles, as the format has it.");
  }
  if (info.cellType == CellType::Triangle && info.mostCorners > 4)
  {
    notes.push_back("Polygons of more than four corners are written as triangles.");
  }
  return notes;
}

} // namespace smg
