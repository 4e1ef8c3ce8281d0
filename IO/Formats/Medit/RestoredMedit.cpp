// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Medit/MeditFormat.h"
#include "IO/Mesh/AttributeNames.h"

#include <string_view>

namespace smg
{

namespace
{

/** Writes elements by their corners, which count from 1, and their references. */
class MeditElements
{
public:
  MeditElements(TextOutput& out, RestoredMesh& mesh, std::ptrdiff_t references)
    : Out(out)
    , Mesh(mesh)
    , References(references)
  {
  }

  /** Writes those for which `choose`, given their number of corners, returns true. */
  template <class Choose>
  void write(std::string_view keyword, std::int64_t count, Choose&& choose)
  {
    if (count == 0)
    {
      return;
    }
    this->Out << keyword << '\n' << count << '\n';
    for (RestoredElements elements; this->Mesh.next(elements);)
    {
      elements.forEach(
        [&](std::span<const std::int64_t> corners, std::size_t element)
        {
          if (choose(corners.size()))
          {
            this->write(elements, element, corners);
          }
        });
    }
    this->Mesh.rewindElements();
  }

private:
  void write(
    const RestoredElements& elements, std::size_t element, std::span<const std::int64_t> corners)
  {
    if (corners.size() <= 4)
    {
      this->writeCell(elements, element, corners);
      return;
    }
    forEachFanTriangle(
      corners, [&](const auto& triangle) { this->writeCell(elements, element, triangle); });
  }

  void writeCell(
    const RestoredElements& elements, std::size_t element, std::span<const std::int64_t> corners)
  {
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      this->Out << (k > 0 ? " " : "") << corners[k] + 1;
    }
    this->Out.tuple(elements.columns, this->References, element, " 0");
    this->Out << '\n';
  }

  TextOutput& Out;
  RestoredMesh& Mesh;
  std::ptrdiff_t References; ///< column
};

} // namespace

WriteNotes writeRestoredMedit(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  PlacedColumns columns(info);
  const std::ptrdiff_t references = columns.integerOfVertices({ ReferenceName, MarkerName });
  out << "MeshVersionFormatted " << (info.doublePositions ? 2 : 1) << "\nDimension 3\nVertices\n"
      << info.vertices << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out.position(positions.subspan(i, 3), info.doublePositions);
      out.tuple(vertices.columns, references, i / 3, " 0");
      out << '\n';
    }
  }
  MeditElements writer(out, mesh, columns.integerOfElements({ ReferenceName, PhysicalTagName }));
  if (info.cellType == CellType::Triangle)
  {
    // All triangles of the stream, except for the two of each quadrilateral.
    writer.write("Triangles", info.cells - 2 * info.quadrilaterals,
      [](std::size_t corners) { return corners != 4; });
    writer.write(
      "Quadrilaterals", info.quadrilaterals, [](std::size_t corners) { return corners == 4; });
  }
  else
  {
    writer.write("Tetrahedra", info.elements, [](std::size_t) { return true; });
  }
  out << "End\n";
  out.finish();
  WriteNotes notes = columns.leftOut(".mesh");
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

std::int64_t bytesOfMedit(const MeshToWrite& written)
{
  constexpr double NoReference = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const std::ptrdiff_t ofVertices = columns.integerOfVertices({ ReferenceName, MarkerName });
  const std::ptrdiff_t ofCells = columns.integerOfElements({ ReferenceName, PhysicalTagName });
  return textBytes(mesh.vertices, positionCharacters(mesh.doublePositions) +
                                    tupleCharacters(mesh.vertexColumns, ofVertices, NoReference)) +
         textBytes(mesh.cells, cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells, NoReference));
}

} // namespace smg
