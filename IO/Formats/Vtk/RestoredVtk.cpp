// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/ByteOrder.h"
#include "IO/Files/PositionedFile.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Mesh/RowBytes.h"
#include "smg/Error.h"

#include <limits>
#include <string_view>

namespace smg
{

namespace
{

/** An array of big-endian numbers that is written in parts at its position in the file. */
class PlacedArray
{
public:
  PlacedArray(std::int64_t at, std::size_t scalarBytes)
    : At(at)
    , ScalarBytes(scalarBytes)
  {
  }

  void append(PositionedFile& file, std::span<const std::byte> scalars)
  {
    this->Bytes.assign(scalars.begin(), scalars.end());
    toByteOrder(std::endian::big, this->Bytes, this->ScalarBytes);
    file.write(this->At, this->Bytes);
    this->At += static_cast<std::int64_t>(scalars.size());
  }

private:
  std::int64_t At;
  std::size_t ScalarBytes;
  std::vector<std::byte> Bytes;
};

/** The name of a type in legacy files. */
std::string_view vtkTypeName(ScalarType type)
{
  constexpr std::string_view names[] = { "char", "unsigned_char", "short", "unsigned_short", "int",
    "unsigned_int", "vtktypeint64", "vtktypeuint64", "float", "double" };
  return names[static_cast<int>(type)];
}

/** A name as one word, in VTK's encoding. */
std::string encoded(const std::string& name)
{
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 127 && c != '"' && c != '%')
    {
      text += c;
      continue;
    }
    text += '%';
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

/** The file; the positions of all arrays are known from the start. */
class VtkFile
{
public:
  VtkFile(const RestoredInfo& info, const std::filesystem::path& path)
    : Info(info)
    , File(path)
  {
    const bool isSurface = info.cellType == CellType::Triangle;
    const std::string cells = std::to_string(info.elements);
    this->writeText("# vtk DataFile Version 3.0\nmesh\nBINARY\nDATASET ");
    this->writeText(isSurface ? "POLYDATA\n" : "UNSTRUCTURED_GRID\n");
    const ScalarType real = info.doublePositions ? ScalarType::Float64 : ScalarType::Float32;
    this->writeText(
      "POINTS " + std::to_string(info.vertices) + ' ' + std::string(vtkTypeName(real)) + '\n');
    this->place(this->Points, real, 3 * info.vertices);
    const std::int64_t numbers = info.elements + info.corners;
    this->writeText(
      (isSurface ? "POLYGONS " : "CELLS ") + cells + ' ' + std::to_string(numbers) + '\n');
    this->place(this->Cells, ScalarType::Int32, numbers);
    if (!isSurface)
    {
      this->writeText("CELL_TYPES " + cells + '\n');
      this->place(this->Types, ScalarType::Int32, info.elements);
    }
    this->placeFields("POINT_DATA ", info.vertices, info.vertexColumns, this->PointData);
    this->placeFields("CELL_DATA ", info.elements, info.elementColumns, this->CellData);
  }

  void append(const RestoredVertices& vertices)
  {
    if (this->Info.doublePositions)
    {
      this->Points[0].append(this->File, std::as_bytes(std::span(vertices.positions)));
    }
    else
    {
      this->Single.assign(vertices.positions.begin(), vertices.positions.end());
      this->Points[0].append(this->File, std::as_bytes(std::span(this->Single)));
    }
    this->append(this->PointData, vertices.columns);
  }

  void append(const RestoredElements& elements)
  {
    this->Numbers.clear();
    elements.forEach(
      [this](std::span<const std::int64_t> corners, std::size_t)
      {
        this->Numbers.push_back(static_cast<std::int32_t>(corners.size()));
        this->Numbers.insert(this->Numbers.end(), corners.begin(), corners.end());
      });
    this->Cells[0].append(this->File, std::as_bytes(std::span(this->Numbers)));
    if (!this->Types.empty())
    {
      constexpr std::int32_t tetrahedron = 10;
      this->Numbers.assign(elements.sizes.size(), tetrahedron);
      this->Types[0].append(this->File, std::as_bytes(std::span(this->Numbers)));
    }
    this->append(this->CellData, elements.columns);
  }

  void finish() { this->File.finish(); }

private:
  using Arrays = std::vector<PlacedArray>;

  void writeText(std::string_view text)
  {
    this->File.write(this->End, std::as_bytes(std::span(text)));
    this->End += static_cast<std::int64_t>(text.size());
  }

  /** Leaves space for an array. */
  void place(Arrays& arrays, ScalarType type, std::int64_t scalars)
  {
    arrays.emplace_back(this->End, sizeOf(type));
    this->End += scalars * static_cast<std::int64_t>(sizeOf(type));
    this->writeText("\n");
  }

  void placeFields(const std::string& keyword, std::int64_t tuples,
    const std::vector<ColumnSpec>& specs, Arrays& arrays)
  {
    if (specs.empty())
    {
      return;
    }
    this->writeText(keyword + std::to_string(tuples) + "\nFIELD FieldData " +
                    std::to_string(specs.size()) + '\n');
    for (const ColumnSpec& spec : specs)
    {
      this->writeText(encoded(spec.name) + ' ' + std::to_string(spec.components) + ' ' +
                      std::to_string(tuples) + ' ' + std::string(vtkTypeName(spec.type)) + '\n');
      this->place(arrays, spec.type, tuples * spec.components);
    }
  }

  void append(Arrays& arrays, const std::vector<Column>& columns)
  {
    for (std::size_t i = 0; i < arrays.size(); ++i)
    {
      arrays[i].append(this->File, columns[i].bytes);
    }
  }

  const RestoredInfo& Info;
  PositionedFile File;
  std::int64_t End = 0; ///< position of the next text
  Arrays Points, Cells, Types, PointData, CellData;
  std::vector<float> Single;
  std::vector<std::int32_t> Numbers;
};

} // namespace

WriteNotes writeRestoredVtk(RestoredMesh& mesh, const std::filesystem::path& path)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (mesh.info().vertices > most)
  {
    throw Error(path.string() + ": such a .vtk file has room for " + std::to_string(most) +
                " vertices, but there are " + std::to_string(mesh.info().vertices) +
                ": choose .vtp or .vtu.");
  }
  VtkFile file(mesh.info(), path);
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    file.append(vertices);
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    file.append(elements);
  }
  file.finish();
  return {};
}

std::int64_t bytesOfVtk(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  const bool isSurface = mesh.cellType == CellType::Triangle;
  const std::int64_t numbers = cornersOf(mesh.cellType) + (isSurface ? 1 : 2);
  return mesh.vertices * rowBytes(mesh.vertexColumns, positionBytes(mesh)) +
         mesh.cells * rowBytes(mesh.cellColumns, numbers * std::int64_t(sizeof(std::int32_t)));
}

} // namespace smg
