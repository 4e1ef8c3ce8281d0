// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkXmlFile.h"

#include "IO/Files/Suffix.h"

#include <bit>
#include <string>

namespace smg
{

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

} // namespace smg
