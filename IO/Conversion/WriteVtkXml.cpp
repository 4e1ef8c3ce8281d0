// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/WriteVtkXml.h"

#include "IO/Conversion/PositionedFile.h"
#include "IO/Formats/VtkXml.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

namespace
{

/** Cell types of VTK. */
constexpr std::uint8_t VtkTriangle = 5;
constexpr std::uint8_t VtkTetra = 10;

std::string lowerSuffix(const std::filesystem::path& path)
{
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

/** An array of the file: where its data go. */
class AppendedArray
{
public:
  AppendedArray(ColumnSpec spec, std::int64_t tuples)
    : Spec(std::move(spec))
    , Bytes(tuples * static_cast<std::int64_t>(this->Spec.tupleBytes()))
  {
  }

  /** Bytes of the array and of their number before it. */
  std::int64_t size() const { return this->Bytes + std::int64_t(sizeof(std::uint64_t)); }

  /** The array's element of the XML, its data at `offset` of the appended data. */
  void describe(std::ostream& xml, std::int64_t offset)
  {
    this->Offset = offset;
    xml << "<DataArray type=\"" << vtkXmlTypeName(this->Spec.type) << "\" Name=\""
        << xmlEscaped(this->Spec.name) << "\" NumberOfComponents=\"" << this->Spec.components
        << "\" format=\"appended\" offset=\"" << offset << "\"/>\n";
  }

  /** Writes the number of bytes; the appended data begin at `base` of the file. */
  void begin(PositionedFile& file, std::int64_t base)
  {
    const auto bytes = static_cast<std::uint64_t>(this->Bytes);
    this->At = base + this->Offset + std::int64_t(sizeof(bytes));
    file.write(base + this->Offset, std::as_bytes(std::span(&bytes, 1)));
  }

  /** Writes the next tuples. */
  void append(PositionedFile& file, std::span<const std::byte> bytes)
  {
    file.write(this->At, bytes);
    this->At += static_cast<std::int64_t>(bytes.size());
  }

private:
  ColumnSpec Spec;
  std::int64_t Bytes;
  std::int64_t Offset = 0;
  std::int64_t At = 0;
};

/** Writes the stream; every array of the file has its place from the start. */
class VtkXmlWriter
{
public:
  VtkXmlWriter(const StreamInfo& info, const std::filesystem::path& path)
    : Info(info)
    , PolyData(lowerSuffix(path) == ".vtp")
    , File(path)
    , Points({ "Points", info.doublePositions ? ScalarType::Float64 : ScalarType::Float32, 3 },
        info.vertices)
    , Corners({ "connectivity", ScalarType::Int64, 1 }, info.cells * cornersOf(info.cellType))
    , Ends({ "offsets", ScalarType::Int64, 1 }, info.cells)
    , Types({ "types", ScalarType::UInt8, 1 }, info.cells)
  {
    for (const ColumnSpec& spec : info.vertexColumns)
    {
      this->PointData.emplace_back(spec, info.vertices);
    }
    for (const ColumnSpec& spec : info.cellColumns)
    {
      this->CellData.emplace_back(spec, info.cells);
    }
    this->writeHeader();
  }

  void append(const MeshBlock& block)
  {
    if (this->Info.doublePositions)
    {
      this->Points.append(this->File, std::as_bytes(std::span(block.positions)));
    }
    else
    {
      this->Single.assign(block.positions.begin(), block.positions.end());
      this->Points.append(this->File, std::as_bytes(std::span(this->Single)));
    }
    for (std::size_t i = 0; i < this->PointData.size(); ++i)
    {
      this->PointData[i].append(this->File, block.vertexColumns[i].bytes);
    }
    this->appendCells(block);
  }

  void finish()
  {
    static constexpr std::string_view Tail = "\n</AppendedData>\n</VTKFile>\n";
    this->File.write(this->End, std::as_bytes(std::span(Tail)));
    this->File.finish();
  }

private:
  void writeHeader()
  {
    std::ostringstream xml;
    const char* type = this->PolyData ? "PolyData" : "UnstructuredGrid";
    const bool little = std::endian::native == std::endian::little;
    xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type << "\" version=\"1.0\" byte_order=\""
        << (little ? "Little" : "Big") << "Endian\" header_type=\"UInt64\">\n<" << type
        << ">\n<Piece NumberOfPoints=\"" << this->Info.vertices << '"';
    if (this->PolyData)
    {
      xml << " NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"";
    }
    else
    {
      xml << " NumberOfCells=\"";
    }
    xml << this->Info.cells << "\">\n";
    std::vector<AppendedArray*> arrays;
    std::int64_t offset = 0;
    const auto describe = [&](AppendedArray& array)
    {
      array.describe(xml, offset);
      offset += array.size();
      arrays.push_back(&array);
    };
    xml << "<PointData>\n";
    std::for_each(this->PointData.begin(), this->PointData.end(), describe);
    xml << "</PointData>\n<CellData>\n";
    std::for_each(this->CellData.begin(), this->CellData.end(), describe);
    xml << "</CellData>\n<Points>\n";
    describe(this->Points);
    xml << "</Points>\n" << (this->PolyData ? "<Polys>\n" : "<Cells>\n");
    describe(this->Corners);
    describe(this->Ends);
    if (!this->PolyData)
    {
      describe(this->Types);
    }
    xml << (this->PolyData ? "</Polys>\n" : "</Cells>\n") << "</Piece>\n</" << type
        << ">\n<AppendedData encoding=\"raw\">\n_";
    const std::string text = xml.str();
    this->File.write(0, std::as_bytes(std::span(text)));
    const auto base = static_cast<std::int64_t>(text.size());
    for (AppendedArray* array : arrays)
    {
      array->begin(this->File, base);
    }
    this->End = base + offset;
  }

  void appendCells(const MeshBlock& block)
  {
    const auto corners = static_cast<std::size_t>(cornersOf(this->Info.cellType));
    const std::size_t cells = block.corners.size() / corners;
    this->Corners.append(this->File, std::as_bytes(std::span(block.corners)));
    this->CellEnds.resize(cells);
    for (std::size_t i = 0; i < cells; ++i)
    {
      this->CellEnds[i] =
        static_cast<std::int64_t>(corners) * (block.firstCell + static_cast<std::int64_t>(i) + 1);
    }
    this->Ends.append(this->File, std::as_bytes(std::span(this->CellEnds)));
    if (!this->PolyData)
    {
      this->CellTypes.assign(cells, corners == 3 ? VtkTriangle : VtkTetra);
      this->Types.append(this->File, std::as_bytes(std::span(this->CellTypes)));
    }
    for (std::size_t i = 0; i < this->CellData.size(); ++i)
    {
      this->CellData[i].append(this->File, block.cellColumns[i].bytes);
    }
  }

  const StreamInfo& Info;
  const bool PolyData;
  PositionedFile File;
  AppendedArray Points, Corners, Ends, Types;
  std::vector<AppendedArray> PointData, CellData;
  std::int64_t End = 0;
  std::vector<float> Single;
  std::vector<std::int64_t> CellEnds;
  std::vector<std::uint8_t> CellTypes;
};

} // namespace

void checkVtkXmlPath(const std::filesystem::path& path, CellType cellType)
{
  const std::string suffix = lowerSuffix(path);
  if (suffix != ".vtu" && suffix != ".vtp")
  {
    throw Error(path.string() + ": the name of a VTK XML file must end with .vtp or .vtu.");
  }
  if (suffix == ".vtp" && cellType != CellType::Triangle)
  {
    throw Error(path.string() + ": a .vtp file holds no tetrahedra: choose .vtu.");
  }
}

void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  checkVtkXmlPath(path, info.cellType);
  Progress reported(progress);
  VtkXmlWriter writer(info, path);
  for (MeshBlock block; source.next(block);)
  {
    writer.append(block);
    const auto end = static_cast<double>(block.firstCell) +
                     static_cast<double>(block.corners.size()) / cornersOf(info.cellType);
    reported.update(end / static_cast<double>(info.cells));
  }
  writer.finish();
}

} // namespace smg
