// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/MeshFileWriter.h"
#include "IO/Files/Base64.h"
#include "IO/Files/ByteOrder.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Vtk/LegacyVtkScanner.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Files of VTK, legacy and XML. As all sizes are known, every array has its place from the start:
// first all texts are written, with room between them for the arrays, then the arrays in parts as
// vertices and cells come.

namespace smg
{

std::string xmlText(std::string_view text)
{
  return replaced(text, "_",
    [](std::string_view character)
    {
      // U+FFFE and U+FFFF are not characters of XML.
      const bool isNone = character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
      return !isControl(character) && !isNone;
    });
}

std::string xmlEscaped(const std::string& text)
{
  std::string result;
  for (const char c : xmlText(text))
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

namespace
{

/** What VTK calls a cell. */
std::uint8_t vtkTypeOf(std::uint32_t corners, CellType cellType)
{
  using namespace VtkCellTypes;
  return cellType == CellType::Tetrahedron ? Tetrahedron
         : corners == 3                    ? Triangle
         : corners == 4                    ? Quadrilateral
                                           : Polygon;
}

/** An array that is written in parts at its place: in a legacy file as big-endian numbers. */
class LegacyArray
{
public:
  /** An array of `tuples` tuples. */
  LegacyArray(const ColumnSpec& spec, std::int64_t tuples)
    : ScalarBytes(sizeOf(spec.type))
    , TotalBytes(tuples * static_cast<std::int64_t>(spec.tupleBytes()))
  {
  }

  /** Begins the array at this place of the file; returns its end. */
  std::int64_t begin(PositionedFile&, std::int64_t at)
  {
    this->At = at;
    return at + this->TotalBytes;
  }

  /** Writes the next tuples. Throws Error. */
  void append(PositionedFile& file, std::span<const std::byte> tuples)
  {
    this->Bytes.assign(tuples.begin(), tuples.end());
    toByteOrder(std::endian::big, this->Bytes, this->ScalarBytes);
    file.write(this->At, this->Bytes);
    this->At += static_cast<std::int64_t>(tuples.size());
  }

  /** Writes what is left after all tuples. */
  void finish(PositionedFile&) {}

private:
  std::size_t ScalarBytes;
  std::int64_t TotalBytes;
  std::int64_t At = 0; ///< place of the next tuples
  std::vector<std::byte> Bytes;
};

/**
 * The same within its element of an XML file: its number of bytes as UInt64, then its bytes, each a
 * unit of base64. With recent versions of Expat, many of VTK's readers refuse appended data.
 */
class InlineArray
{
public:
  InlineArray(const ColumnSpec& spec, std::int64_t tuples)
    : TotalBytes(tuples * static_cast<std::int64_t>(spec.tupleBytes()))
  {
  }

  std::int64_t begin(PositionedFile& file, std::int64_t at)
  {
    const auto bytes = static_cast<std::uint64_t>(this->TotalBytes);
    this->At = at;
    this->append(file, std::as_bytes(std::span(&bytes, 1)));
    this->finish(file);
    return this->At + Base64Encoder::encodedSize(this->TotalBytes);
  }

  void append(PositionedFile& file, std::span<const std::byte> tuples)
  {
    std::string text;
    this->Encoder.append(tuples, text);
    this->write(file, text);
  }

  void finish(PositionedFile& file)
  {
    std::string text;
    this->Encoder.finish(text);
    this->write(file, text);
  }

private:
  void write(PositionedFile& file, const std::string& text)
  {
    file.write(this->At, std::as_bytes(std::span(text)));
    this->At += static_cast<std::int64_t>(text.size());
  }

  std::int64_t TotalBytes;
  std::int64_t At = 0;
  Base64Encoder Encoder; ///< holds at most two bytes of the data back
};

/** What the files of VTK have in common: texts, and arrays of points, cells and columns. */
template <class Array>
class VtkWriter : public MeshFileWriter
{
public:
  void vertices(const VertexChunk& chunk) override
  {
    this->append(this->Points, this->Positions.bytes(chunk.positions));
    this->append(this->PointData, chunk.columns);
  }

  WriteNotes finish() override
  {
    for (std::vector<Array>* const arrays :
      { &this->Points, &this->Cells, &this->Ends, &this->Types, &this->PointData, &this->CellData })
    {
      for (Array& array : *arrays)
      {
        array.finish(this->File);
      }
    }
    this->File.finish();
    return {};
  }

protected:
  VtkWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Info(info)
    , Positions(info.doublePositions)
    , File(path)
  {
  }

  void writeText(std::string_view text)
  {
    this->File.write(this->End, std::as_bytes(std::span(text)));
    this->End += static_cast<std::int64_t>(text.size());
  }

  /** Leaves room for an array, which is the last of `arrays`. */
  void place(std::vector<Array>& arrays, const ColumnSpec& spec, std::int64_t tuples)
  {
    arrays.emplace_back(spec, tuples);
    this->End = arrays.back().begin(this->File, this->End);
  }

  /** Appends to an array that the file may have. */
  void append(std::vector<Array>& arrays, std::span<const std::byte> tuples)
  {
    if (!arrays.empty())
    {
      arrays[0].append(this->File, tuples);
    }
  }
  void append(std::vector<Array>& arrays, const std::vector<Column>& columns)
  {
    for (std::size_t i = 0; i < arrays.size(); ++i)
    {
      arrays[i].append(this->File, columns[i].bytes);
    }
  }

  const MeshFileInfo Info;
  FilePositions Positions;
  PositionedFile File;
  std::int64_t End = 0; ///< of the texts and arrays so far
  /** At most one array each of points and cells, and those of the columns. */
  std::vector<Array> Points, Cells, Ends, Types, PointData, CellData;
};

} // namespace

std::string encodedVtkName(const std::string& name)
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

std::string legacyGroups(const MeshGroups& groups, bool asText)
{
  if (groups.empty())
  {
    return {};
  }
  const std::string text = textOf(groups);
  std::string field = std::string("FIELD FieldData 1\n") + MeshGroupsName + " 1 1 string\n";
  if (asText)
  {
    return field + encodedVtkName(text) + '\n';
  }
  // The length, big-endian, whose highest bits tell that it has four bytes.
  constexpr std::uint32_t FourBytes = std::uint32_t(1) << 30;
  const std::uint32_t length = FourBytes | static_cast<std::uint32_t>(text.size());
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    field += static_cast<char>(length >> shift & 0xff);
  }
  return field + text + '\n';
}

LegacyColumns::LegacyColumns(const std::vector<ColumnSpec>& specs, bool ofVertices)
  : Specs(specs)
  , OfVertices(ofVertices)
  , Order(specs.size())
{
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  std::ranges::stable_partition(
    this->Order, [this](std::size_t k) { return this->keywordOf(this->Specs[k]).empty(); });
}

std::string LegacyColumns::keywordOf(const ColumnSpec& spec) const
{
  return !this->OfVertices       ? ""
         : isActiveNormals(spec) ? "NORMALS"
         : isActiveTexture(spec) ? "TEXTURE_COORDINATES"
                                 : "";
}

std::string LegacyColumns::linesBefore(std::size_t column, std::int64_t tuples) const
{
  const ColumnSpec& spec = this->Specs[column];
  const std::string components = std::to_string(spec.components) + ' ';
  const std::string name = encodedVtkName(spec.name) + ' ';
  const std::string type = std::string(legacyTypeName(spec.type)) + '\n';
  const bool isFirst = column == this->Order.front();
  std::string lines =
    isFirst ? (this->OfVertices ? "POINT_DATA " : "CELL_DATA ") + std::to_string(tuples) + '\n'
            : "";
  if (const std::string keyword = this->keywordOf(spec); !keyword.empty())
  {
    return lines + keyword + ' ' + name + (isActiveTexture(spec) ? components : "") + type;
  }
  if (isFirst)
  {
    const auto fields = std::ranges::count_if(
      this->Specs, [this](const ColumnSpec& each) { return this->keywordOf(each).empty(); });
    lines += "FIELD FieldData " + std::to_string(fields) + '\n';
  }
  return lines + name + components + std::to_string(tuples) + ' ' + type;
}

namespace
{

/** Throws Error if there are more vertices than a legacy file has numbers for. */
void checkLegacyVertices(const std::filesystem::path& path, std::int64_t vertices)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices > most)
  {
    throw Error(path.string() + ": such a .vtk file has room for " + std::to_string(most) +
                " vertices, but there are " + std::to_string(vertices) + ": choose .vtp or .vtu.");
  }
}

/** Legacy VTK, binary, version 3.0, which is widely supported: polygonal data, or an unstructured
 * grid of tetrahedra, with the columns as LegacyColumns. Corners are 32-bit numbers. */
class LegacyVtkWriter : public VtkWriter<LegacyArray>
{
public:
  LegacyVtkWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : VtkWriter(path, info)
  {
    const bool isSurface = info.cellType == CellType::Triangle;
    const std::string cells = std::to_string(info.elements);
    const std::int64_t numbers = info.elements + info.corners;
    const ScalarType real = this->Positions.type();
    this->writeText("# vtk DataFile Version 3.0\nmesh\nBINARY\nDATASET ");
    this->writeText(isSurface ? "POLYDATA\n" : "UNSTRUCTURED_GRID\n");
    this->writeText(legacyGroups(info.groupTable, false));
    this->writeText(
      "POINTS " + std::to_string(info.vertices) + ' ' + std::string(legacyTypeName(real)) + '\n');
    this->placeLine(this->Points, { "", real, 3 }, info.vertices);
    this->writeText(
      (isSurface ? "POLYGONS " : "CELLS ") + cells + ' ' + std::to_string(numbers) + '\n');
    this->placeLine(this->Cells, { "", ScalarType::Int32, 1 }, numbers);
    if (!isSurface)
    {
      this->writeText("CELL_TYPES " + cells + '\n');
      this->placeLine(this->Types, { "", ScalarType::Int32, 1 }, info.elements);
    }
    this->placeColumns(info.vertices, info.vertexColumns, this->PointData);
    this->placeColumns(info.elements, info.elementColumns, this->CellData);
    this->File.reserve(this->End);
  }

  void elements(const ElementChunk& chunk) override
  {
    this->Numbers.clear();
    chunk.forEach(
      [this](std::span<const std::int64_t> corners, std::size_t)
      {
        this->Numbers.push_back(static_cast<std::int32_t>(corners.size()));
        this->Numbers.insert(this->Numbers.end(), corners.begin(), corners.end());
      });
    this->append(this->Cells, std::as_bytes(std::span(this->Numbers)));
    this->Numbers.assign(chunk.sizes.size(), VtkCellTypes::Tetrahedron);
    this->append(this->Types, std::as_bytes(std::span(this->Numbers)));
    this->append(this->CellData, chunk.columns);
  }

private:
  void placeLine(std::vector<LegacyArray>& arrays, const ColumnSpec& spec, std::int64_t tuples)
  {
    this->place(arrays, spec, tuples);
    this->writeText("\n");
  }

  void placeColumns(
    std::int64_t tuples, const std::vector<ColumnSpec>& specs, std::vector<LegacyArray>& arrays)
  {
    for (const ColumnSpec& spec : specs)
    {
      arrays.emplace_back(spec, tuples);
    }
    const LegacyColumns columns(specs, &arrays == &this->PointData);
    for (const std::size_t k : columns.order())
    {
      this->writeText(columns.linesBefore(k, tuples));
      this->End = arrays[k].begin(this->File, this->End);
      this->writeText("\n");
    }
  }

  std::vector<std::int32_t> Numbers;
};

/** The names of columns in an XML file, each once; notes those that are not what they were. */
std::vector<std::string> xmlNames(const std::vector<ColumnSpec>& specs, WriteNotes& notes)
{
  std::set<std::string> taken;
  for (const ColumnSpec& spec : specs)
  {
    taken.insert(spec.name);
  }
  std::vector<std::string> names;
  for (const ColumnSpec& spec : specs)
  {
    const std::string base = xmlText(spec.name);
    std::string& name = names.emplace_back(base);
    for (int k = 1; name != spec.name && !taken.insert(name).second; ++k)
    {
      name = base + '_' + std::to_string(k);
    }
    if (name != spec.name)
    {
      notes.push_back("The column " + inQuotes(spec.name) + " is called " + inQuotes(name) +
                      " in the file, since XML cannot hold its name.");
    }
  }
  return names;
}

/** The attributes of <PointData> that name its active arrays. */
std::string activeOf(const std::vector<ColumnSpec>& columns)
{
  std::string attributes;
  for (const ColumnSpec& spec : columns)
  {
    attributes += isActiveNormals(spec) ? std::string(" Normals=\"") + NormalsName + '"'
                  : isActiveTexture(spec)
                    ? std::string(" TCoords=\"") + TextureCoordinatesName + '"'
                    : "";
  }
  return attributes;
}

/** The groups as a text of the field data, by the codes of its characters; empty: there are none.
 * Numbers, since programs other than VTK (meshio) refuse files with texts. */
std::string groupsElement(const MeshGroups& groups)
{
  if (groups.empty())
  {
    return {};
  }
  const std::string text = textOf(groups);
  std::string element = std::string("<FieldData>\n<DataArray type=\"UInt8\" Name=\"") +
                        MeshGroupsName + "\" NumberOfTuples=\"" + std::to_string(text.size()) +
                        "\" format=\"ascii\">\n";
  for (const char c : text)
  {
    element += std::to_string(static_cast<unsigned char>(c)) + ' ';
  }
  return element + "\n</DataArray>\n</FieldData>\n";
}

/** VTK XML: PolyData if the name ends with .vtp, else an UnstructuredGrid. Corners are 64-bit
 * numbers. */
class VtkXmlWriter : public VtkWriter<InlineArray>
{
public:
  VtkXmlWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : VtkWriter(path, info)
    , IsPolyData(lowerSuffix(path) == ".vtp")
  {
    const std::string type = this->IsPolyData ? "PolyData" : "UnstructuredGrid";
    const std::string cells = this->IsPolyData ? "Polys>\n" : "Cells>\n";
    const bool little = std::endian::native == std::endian::little;
    this->writeText(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
      (little ? "Little" : "Big") + "Endian\" header_type=\"UInt64\">\n<" + type + ">\n" +
      groupsElement(info.groupTable) + "<Piece NumberOfPoints=\"" + std::to_string(info.vertices) +
      (this->IsPolyData ? "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                          "NumberOfStrips=\"0\" NumberOfPolys=\""
                        : "\" NumberOfCells=\"") +
      std::to_string(info.elements) + "\">\n<PointData" + activeOf(info.vertexColumns) + ">\n");
    this->placeElements(this->PointData, info.vertexColumns, info.vertices);
    this->writeText("</PointData>\n<CellData>\n");
    this->placeElements(this->CellData, info.elementColumns, info.elements);
    this->writeText("</CellData>\n<Points>\n");
    this->placeElement(this->Points, { "Points", this->Positions.type(), 3 }, info.vertices);
    this->writeText("</Points>\n<" + cells);
    this->placeElement(this->Cells, { "connectivity", ScalarType::Int64, 1 }, info.corners);
    this->placeElement(this->Ends, { "offsets", ScalarType::Int64, 1 }, info.elements);
    if (!this->IsPolyData)
    {
      this->placeElement(this->Types, { "types", ScalarType::UInt8, 1 }, info.elements);
    }
    this->writeText("</" + cells + "</Piece>\n</" + type + ">\n</VTKFile>\n");
    this->File.reserve(this->End);
  }

  void elements(const ElementChunk& chunk) override
  {
    this->CellEnds.clear();
    this->CellTypes.clear();
    for (const std::uint32_t size : chunk.sizes)
    {
      this->CellEnds.push_back(this->LastEnd += size);
      this->CellTypes.push_back(vtkTypeOf(size, this->Info.cellType));
    }
    this->append(this->Cells, std::as_bytes(std::span(chunk.corners)));
    this->append(this->Ends, std::as_bytes(std::span(this->CellEnds)));
    this->append(this->Types, std::as_bytes(std::span(this->CellTypes)));
    this->append(this->CellData, chunk.columns);
  }

  WriteNotes finish() override
  {
    VtkWriter::finish();
    return std::move(this->Notes);
  }

private:
  void placeElements(
    std::vector<InlineArray>& arrays, const std::vector<ColumnSpec>& specs, std::int64_t tuples)
  {
    const std::vector<std::string> names = xmlNames(specs, this->Notes);
    for (std::size_t i = 0; i < specs.size(); ++i)
    {
      this->placeElement(arrays, { names[i], specs[i].type, specs[i].components }, tuples);
    }
  }

  void placeElement(std::vector<InlineArray>& arrays, const ColumnSpec& spec, std::int64_t tuples)
  {
    this->writeText("<DataArray type=\"" + std::string(vtkXmlTypeName(spec.type)) + "\" Name=\"" +
                    xmlEscaped(spec.name) + "\" NumberOfComponents=\"" +
                    std::to_string(spec.components) + "\" format=\"binary\">\n");
    this->place(arrays, spec, tuples);
    this->writeText("\n</DataArray>\n");
  }

  const bool IsPolyData;
  WriteNotes Notes;
  std::int64_t LastEnd = 0; ///< corners of all cells so far
  std::vector<std::int64_t> CellEnds;
  std::vector<std::uint8_t> CellTypes;
};

} // namespace

std::unique_ptr<MeshFileWriter> makeLegacyVtkWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* space)
{
  checkLegacyVertices(path, info.vertices);
  if (info.text)
  {
    return makeTextVtkWriter(path, info, space);
  }
  return std::make_unique<LegacyVtkWriter>(path, info);
}

std::unique_ptr<MeshFileWriter> makeVtkXmlWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace*)
{
  return std::make_unique<VtkXmlWriter>(path, info);
}

std::int64_t bytesOfVtk(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  const bool isSurface = mesh.cellType == CellType::Triangle;
  if (written.text)
  {
    return bytesOfTextVtk(mesh);
  }
  const std::int64_t numbers = cornersOf(mesh.cellType) + (isSurface ? 1 : 2);
  return mesh.vertices * rowBytes(mesh.vertexColumns, positionBytes(mesh)) +
         mesh.cells * rowBytes(mesh.cellColumns, numbers * std::int64_t(sizeof(std::int32_t)));
}

std::int64_t bytesOfVtkXml(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  const std::int64_t typeBytes = written.suffix.text == ".vtp" ? 0 : 1;
  const std::int64_t numbers = cornersOf(mesh.cellType) + 1;
  const std::int64_t bytes =
    mesh.vertices * rowBytes(mesh.vertexColumns, positionBytes(mesh)) +
    mesh.cells *
      rowBytes(mesh.cellColumns, numbers * std::int64_t(sizeof(std::int64_t)) + typeBytes);
  return bytes / 3 * 4; // base64
}

} // namespace smg
