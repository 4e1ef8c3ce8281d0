// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkFormats.h"

#include "IO/Export/RestoredMesh.h"
#include "IO/Files/ByteOrder.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Vtk/LegacyVtkLayout.h"
#include "IO/Formats/Vtk/VtkMeshReader.h"
#include "IO/Formats/Vtk/VtkXmlFile.h"
#include "IO/Formats/Vtk/VtkXmlLayout.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace smg
{

namespace
{

bool isLegacyVtk(std::string_view start)
{
  return textStart(start).starts_with("# vtk DataFile");
}

/** The type in the element VTKFile; empty if it is not such a file. */
std::optional<std::string_view> typeOfXml(std::string_view start)
{
  const std::string_view text = textStart(start);
  const std::size_t at = text.find("<VTKFile");
  if (!text.starts_with('<') || at == std::string_view::npos)
  {
    return {};
  }
  const std::string_view tag = text.substr(at, text.find('>', at) - at);
  const std::size_t type = tag.find(" type=");
  constexpr std::size_t beforeValue = 7; // blank, name, equals sign and quotation mark
  return tag.substr(
    type == std::string_view::npos ? tag.size() : std::min(type + beforeValue, tag.size()));
}

bool isParallelVtkXml(std::string_view start)
{
  const std::optional<std::string_view> type = typeOfXml(start);
  return type && (type->starts_with("PPolyData") || type->starts_with("PUnstructuredGrid"));
}

bool isVtkXml(std::string_view start)
{
  return typeOfXml(start) && !isParallelVtkXml(start);
}

WriteNotes writeXml(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  writeVtkXml(source, path, options.progress);
  return {};
}

void parseParallel(
  InputFile& file, RawMeshBuilder& builder, const MeshPart&, const ProgressFunction& progress)
{
  importParallelVtkXml(file, builder, progress);
}

constexpr FileSuffix LegacySuffixes[] = { { ".vtk" } };
constexpr FileSuffix XmlSuffixes[] = { { ".vtp", true, false }, { ".vtu" } };
constexpr FileSuffix ParallelSuffixes[] = { { ".pvtp", true, false }, { ".pvtu" } };

} // namespace

void importLegacyVtk(InputFile& file, RawMeshBuilder& builder)
{
  readVtkMesh(file, legacyVtkLayout(file), builder);
}

void importVtkXml(InputFile& file, RawMeshBuilder& builder)
{
  VtkLayout layout;
  addVtkXmlLayout(file, layout, builder.workspace().available() / 2);
  readVtkMesh(file, layout, builder);
}

const Format LegacyVtkFormat{
  .name = "legacy VTK",
  .suffixes = LegacySuffixes,
  .attributes = AllColumns,
  .hasSign = isLegacyVtk,
  .parse = parseWith<importLegacyVtk>,
  .share = { 45, 3 },
  .bytes = bytesOfVtk,
  .restore = writeRestoredVtk,
};

const Format VtkXmlFormat{
  .name = "VTK XML",
  .suffixes = XmlSuffixes,
  .attributes = AllColumns,
  .hasSign = isVtkXml,
  .parse = parseWith<importVtkXml>,
  .bytes = bytesOfVtkXml,
  .write = writeXml,
  .restore = writeRestoredVtkXml,
};

const Format ParallelVtkXmlFormat{
  .name = "VTK XML in pieces",
  .suffixes = ParallelSuffixes,
  .attributes = AllColumns,
  .hasSign = isParallelVtkXml,
  .parse = parseParallel,
};

namespace
{

/** The names of the pieces are held in memory. */
constexpr std::size_t MaxPieces = 100000;

/** The files that a .pvtp or .pvtu file names. Throws Error if it is none. */
std::vector<std::filesystem::path> pieceFiles(InputFile& file)
{
  XmlTags tags(file);
  const XmlTag root = vtkXmlRoot(file, tags);
  const std::string kind = root.value("type");
  if (kind != "PPolyData" && kind != "PUnstructuredGrid")
  {
    file.fail(root.begin, "the file names no pieces of polygonal data or of an unstructured grid "
                          "of VTK, which are the kinds that hold meshes");
  }
  // Beside the file that the user knows, of which this one may be the inflated one.
  const std::filesystem::path folder = std::filesystem::path(file.name()).parent_path();
  std::vector<std::filesystem::path> files;
  for (XmlTag tag; tags.next(tag);)
  {
    if (tag.name == "Piece" && !tag.closes)
    {
      const std::string source = tag.value("Source");
      if (source.empty())
      {
        file.fail(tag.begin, "the piece here has no Source: the file is damaged");
      }
      if (files.size() == MaxPieces)
      {
        file.fail(tag.begin,
          "there are more than " + std::to_string(MaxPieces) + " pieces, which are too many");
      }
      if (nearbyFile(folder, source).empty())
      {
        file.fail(tag.begin, "the piece " + inQuotes(source) +
                               " is not in the folder of the file or below: only such "
                               "files are read");
      }
      files.push_back(folder / source);
    }
  }
  if (files.empty())
  {
    file.fail(root.begin, "the file names no pieces");
  }
  return files;
}

} // namespace

void importParallelVtkXml(
  InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  const std::int64_t maxBytes = builder.workspace().available() / 2;
  VtkLayout layout;
  for (const std::filesystem::path& path : pieceFiles(file))
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
    {
      throw Error(file.name() + ": the piece " + inQuotes(path.string()) +
                  " that the file names does not exist.");
    }
    InputFile piece(path);
    addVtkXmlLayout(piece, layout, maxBytes);
  }
  readVtkMesh(file, layout, builder, progress);
}

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
