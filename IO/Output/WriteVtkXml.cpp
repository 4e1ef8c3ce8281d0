// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Output/WriteVtkXml.h"

#include "IO/Formats/Suffix.h"
#include "IO/Output/InlineArray.h"
#include "IO/Output/PositionedFile.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <bit>
#include <span>
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
    this->writeFrame();
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
    for (InlineArray* array : this->Arrays)
    {
      array->finish(this->File);
    }
    this->File.finish();
  }

private:
  /** Writes all but the tuples, for which it leaves space. */
  void writeFrame()
  {
    const std::string type = this->PolyData ? "PolyData" : "UnstructuredGrid";
    const bool little = std::endian::native == std::endian::little;
    this->writeText("<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
                    "\" version=\"1.0\" byte_order=\"" + (little ? "Little" : "Big") +
                    "Endian\" header_type=\"UInt64\">\n<" + type + ">\n<Piece NumberOfPoints=\"" +
                    std::to_string(this->Info.vertices) +
                    (this->PolyData ? "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                                      "NumberOfStrips=\"0\" NumberOfPolys=\""
                                    : "\" NumberOfCells=\"") +
                    std::to_string(this->Info.cells) + "\">\n<PointData>\n");
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
      this->place(this->Types);
    }
    this->writeText(
      (this->PolyData ? "</Polys>\n" : "</Cells>\n") + ("</Piece>\n</" + type) + ">\n</VTKFile>\n");
  }

  void writeText(std::string_view text)
  {
    this->File.write(this->End, std::as_bytes(std::span(text)));
    this->End += static_cast<std::int64_t>(text.size());
  }

  void place(InlineArray& array)
  {
    this->writeText(array.tag());
    this->End = array.begin(this->File, this->End);
    this->writeText("\n</DataArray>\n");
    this->Arrays.push_back(&array);
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
  InlineArray Points, Corners, Ends, Types;
  std::vector<InlineArray> PointData, CellData;
  std::vector<InlineArray*> Arrays; ///< those of the file
  std::int64_t End = 0;             ///< where the next text of the frame goes
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
