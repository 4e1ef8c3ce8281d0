// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkXmlFile.h"

#include "IO/Export/RestoredMesh.h"
#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include <bit>
#include <cctype>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

InlineArray::InlineArray(ColumnSpec spec, std::int64_t tuples)
  : Spec(std::move(spec))
  , Bytes(tuples * static_cast<std::int64_t>(this->Spec.tupleBytes()))
{
}

std::string InlineArray::tag() const
{
  return "<DataArray type=\"" + vtkXmlTypeName(this->Spec.type) + "\" Name=\"" +
         xmlEscaped(this->Spec.name) + "\" NumberOfComponents=\"" +
         std::to_string(this->Spec.components) + "\" format=\"binary\">\n";
}

std::int64_t InlineArray::begin(PositionedFile& file, std::int64_t at)
{
  const auto bytes = static_cast<std::uint64_t>(this->Bytes);
  this->At = at;
  this->append(file, std::as_bytes(std::span(&bytes, 1)));
  this->finish(file);
  return this->At + Base64Encoder::encodedSize(this->Bytes);
}

void InlineArray::append(PositionedFile& file, std::span<const std::byte> bytes)
{
  std::string text;
  this->Encoder.append(bytes, text);
  this->write(file, text);
}

void InlineArray::finish(PositionedFile& file)
{
  std::string text;
  this->Encoder.finish(text);
  this->write(file, text);
}

void InlineArray::write(PositionedFile& file, const std::string& text)
{
  file.write(this->At, std::as_bytes(std::span(text)));
  this->At += static_cast<std::int64_t>(text.size());
}

namespace
{

/** What VTK calls a cell. */
std::uint8_t vtkTypeOf(std::uint32_t corners, CellType cellType)
{
  constexpr std::uint8_t Triangle = 5, Polygon = 7, Quadrilateral = 9, Tetrahedron = 10;
  return cellType == CellType::Tetrahedron ? Tetrahedron
         : corners == 3                    ? Triangle
         : corners == 4                    ? Quadrilateral
                                           : Polygon;
}

} // namespace

VtkXmlFile::VtkXmlFile(const std::filesystem::path& path, const VtkXmlContent& content)
  : PolyData(lowerSuffix(path) == ".vtp")
  , DoublePositions(content.doublePositions)
  , CellKind(content.cellType)
  , File(path)
  , Points({ "Points", content.doublePositions ? ScalarType::Float64 : ScalarType::Float32, 3 },
      content.points)
  , Corners({ "connectivity", ScalarType::Int64, 1 }, content.corners)
  , Ends({ "offsets", ScalarType::Int64, 1 }, content.cells)
  , Kinds({ "types", ScalarType::UInt8, 1 }, content.cells)
{
  for (const ColumnSpec& spec : content.pointData)
  {
    this->PointData.emplace_back(spec, content.points);
  }
  for (const ColumnSpec& spec : content.cellData)
  {
    this->CellData.emplace_back(spec, content.cells);
  }
  this->writeFrame(content);
  this->File.reserve(this->End);
}

/** Writes all but the tuples, for which it leaves space. */
void VtkXmlFile::writeFrame(const VtkXmlContent& content)
{
  const std::string type = this->PolyData ? "PolyData" : "UnstructuredGrid";
  const bool little = std::endian::native == std::endian::little;
  this->writeText("<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
                  "\" version=\"1.0\" byte_order=\"" + (little ? "Little" : "Big") +
                  "Endian\" header_type=\"UInt64\">\n<" + type + ">\n<Piece NumberOfPoints=\"" +
                  std::to_string(content.points) +
                  (this->PolyData ? "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                                    "NumberOfStrips=\"0\" NumberOfPolys=\""
                                  : "\" NumberOfCells=\"") +
                  std::to_string(content.cells) + "\">\n<PointData>\n");
  for (InlineArray& array : this->PointData)
  {
    this->place(array);
  }
  this->writeText("</PointData>\n<CellData>\n");
  for (InlineArray& array : this->CellData)
  {
    this->place(array);
  }
  this->writeText("</CellData>\n<Points>\n");
  this->place(this->Points);
  this->writeText(this->PolyData ? "</Points>\n<Polys>\n" : "</Points>\n<Cells>\n");
  this->place(this->Corners);
  this->place(this->Ends);
  if (!this->PolyData)
  {
    this->place(this->Kinds);
  }
  this->writeText(
    (this->PolyData ? "</Polys>\n" : "</Cells>\n") + ("</Piece>\n</" + type) + ">\n</VTKFile>\n");
}

void VtkXmlFile::writeText(std::string_view text)
{
  this->File.write(this->End, std::as_bytes(std::span(text)));
  this->End += static_cast<std::int64_t>(text.size());
}

void VtkXmlFile::place(InlineArray& array)
{
  this->writeText(array.tag());
  this->End = array.begin(this->File, this->End);
  this->writeText("\n</DataArray>\n");
  this->Arrays.push_back(&array);
}

void VtkXmlFile::appendPoints(std::span<const double> positions, const std::vector<Column>& columns)
{
  if (this->DoublePositions)
  {
    this->Points.append(this->File, std::as_bytes(positions));
  }
  else
  {
    this->Single.assign(positions.begin(), positions.end());
    this->Points.append(this->File, std::as_bytes(std::span(this->Single)));
  }
  for (std::size_t i = 0; i < this->PointData.size(); ++i)
  {
    this->PointData[i].append(this->File, columns[i].bytes);
  }
}

void VtkXmlFile::appendCells(std::span<const std::int64_t> corners,
  std::span<const std::uint32_t> sizes, const std::vector<Column>& columns)
{
  this->CellEnds.clear();
  this->CellKinds.clear();
  for (const std::uint32_t size : sizes)
  {
    this->CellEnds.push_back(this->LastEnd += size);
    this->CellKinds.push_back(vtkTypeOf(size, this->CellKind));
  }
  this->Corners.append(this->File, std::as_bytes(corners));
  this->Ends.append(this->File, std::as_bytes(std::span(this->CellEnds)));
  if (!this->PolyData)
  {
    this->Kinds.append(this->File, std::as_bytes(std::span(this->CellKinds)));
  }
  for (std::size_t i = 0; i < this->CellData.size(); ++i)
  {
    this->CellData[i].append(this->File, columns[i].bytes);
  }
}

void VtkXmlFile::finish()
{
  for (InlineArray* array : this->Arrays)
  {
    array->finish(this->File);
  }
  this->File.finish();
}

std::string vtkXmlTypeName(ScalarType type)
{
  std::string name(nameOf(type));
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name[0] == 'U' ? "UI" + name.substr(2) : name;
}

std::string xmlEscaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
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

void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  if (info.cellType == CellType::Tetrahedron && lowerSuffix(path) == ".vtp")
  {
    throw Error(path.string() + ": a .vtp file holds no tetrahedra: choose .vtu.");
  }
  Progress reported(progress);
  const auto corners = static_cast<std::uint32_t>(cornersOf(info.cellType));
  VtkXmlFile file(path, { info.cellType, info.doublePositions, info.vertices, info.cells,
                          info.cells * corners, info.vertexColumns, info.cellColumns });
  std::int64_t vertices = 0, cells = 0;
  std::vector<std::uint32_t> sizes;
  for (MeshBlock block; source.next(block);)
  {
    file.appendPoints(block.positions, block.vertexColumns);
    sizes.assign(block.corners.size() / corners, corners);
    file.appendCells(block.corners, sizes, block.cellColumns);
    vertices += block.vertices();
    cells += static_cast<std::int64_t>(sizes.size());
    const auto end =
      static_cast<double>(block.firstCell) + static_cast<double>(block.corners.size()) / corners;
    reported.update(end / static_cast<double>(info.cells));
  }
  if (vertices != info.vertices || cells != info.cells)
  {
    throw Error(otherCounts(path.string(), info));
  }
  file.finish();
}

WriteNotes writeRestoredVtkXml(RestoredMesh& mesh, const std::filesystem::path& path)
{
  const RestoredInfo& info = mesh.info();
  VtkXmlFile file(path, { info.cellType, info.doublePositions, info.vertices, info.elements,
                          info.corners, info.vertexColumns, info.elementColumns });
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    file.appendPoints(vertices.positions, vertices.columns);
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    file.appendCells(elements.corners, elements.sizes, elements.columns);
  }
  file.finish();
  return {};
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
