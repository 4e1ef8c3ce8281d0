// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/Hdf5/WriteVtkHdf.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5Output.h"
#include "IO/Formats/VtkHdf/Hdf5/VtkHdfLayout.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Core/Progress.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace smg
{

namespace
{

class GridWriter
{
public:
  GridWriter(VsmReader& reader, const std::filesystem::path& path, std::int64_t partitions)
    : Reader(reader)
    , Out(path)
    , Positions(reader.info().doublePositions)
  {
    const StreamInfo& info = reader.info();
    this->Out.addGroup("/VTKHDF");
    constexpr std::array<std::int64_t, 2> version{ 1, 0 };
    this->Out.addIntegers("/VTKHDF", "Version", version);
    this->Out.addText("/VTKHDF", "Type", "UnstructuredGrid");
    if (!info.groups.empty())
    {
      this->Out.addText("/VTKHDF", MeshGroupsName, textOf(info.groups));
    }
    for (const char* name : { "NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds" })
    {
      this->Out.addDataset(VtkHdfRoot + name, ScalarType::Int64, 0, partitions);
    }
    this->Out.addDataset(
      VtkHdfRoot + "Connectivity", ScalarType::Int64, 0, info.cells * cornersOf(info.cellType));
    this->Out.addDataset(VtkHdfRoot + "Offsets", ScalarType::Int64, 0, info.cells + partitions);
    this->Out.addDataset(VtkHdfRoot + "Types", ScalarType::UInt8, 0, info.cells);
    this->Out.addDataset(VtkHdfRoot + "Points", this->Positions.type(), 3, info.vertices);
    this->Out.addGroup(this->PointData);
    this->Out.addText(this->PointData, "GlobalIds", GlobalIdsName);
    this->Out.addGroup(this->CellData);
    this->Out.addDataset(
      this->PointData + '/' + GlobalIdsName, ScalarType::Int64, 0, info.vertices);
    this->Out.addDataset(
      this->PointData + '/' + GhostTypeName, ScalarType::UInt8, 0, info.vertices);
    this->addColumns(this->PointData, info.vertexColumns, info.vertices, this->PointNames);
    this->addColumns(this->CellData, info.cellColumns, info.cells, this->CellNames);
  }

  void write(const MeshPiece& piece)
  {
    const auto corners = static_cast<std::size_t>(cornersOf(this->Reader.info().cellType));
    const std::size_t cells = piece.corners.size() / corners;
    this->append("NumberOfPoints", piece.ids.size());
    this->append("NumberOfCells", cells);
    this->append("NumberOfConnectivityIds", piece.corners.size());
    this->Out.append(VtkHdfRoot + "Connectivity", std::span<const std::int64_t>(piece.corners));
    this->Ends.resize(cells + 1);
    for (std::size_t i = 0; i <= cells; ++i)
    {
      this->Ends[i] = static_cast<std::int64_t>(i * corners);
    }
    this->Out.append(VtkHdfRoot + "Offsets", std::span<const std::int64_t>(this->Ends));
    this->Bytes.assign(cells, corners == 3 ? VtkCellTypes::Triangle : VtkCellTypes::Tetrahedron);
    this->Out.append(VtkHdfRoot + "Types", std::span<const std::uint8_t>(this->Bytes));
    this->Out.append(VtkHdfRoot + "Points", this->Positions.bytes(piece.positions));
    this->Out.append(
      this->PointData + '/' + GlobalIdsName, std::span<const std::int64_t>(piece.ids));
    this->Out.append(
      this->PointData + '/' + GhostTypeName, std::span<const std::uint8_t>(piece.ghost));
    this->writeColumns(this->PointNames, piece.vertexColumns);
    this->writeColumns(this->CellNames, piece.cellColumns);
  }

  void finish() { this->Out.finish(); }
  const WriteNotes& notes() const { return this->Notes; }

private:
  /** Adds a dataset for each column, with these names. */
  void addColumns(const std::string& group, const std::vector<ColumnSpec>& columns,
    std::int64_t rows, std::vector<std::string>& names)
  {
    for (const ColumnSpec& column : columns)
    {
      std::string name = column.name;
      // A slash would create another group, and a dot is the group itself.
      std::ranges::replace(name, '/', '_');
      name = name == "." ? "_" : name;
      while (std::ranges::find(names, group + '/' + name) != names.end())
      {
        name += '_';
      }
      if (name != column.name)
      {
        this->Notes.push_back(
          "The column " + inQuotes(column.name) + " is called " + inQuotes(name) + " in the file.");
      }
      names.push_back(group + '/' + name);
      this->Out.addDataset(
        names.back(), column.type, column.components > 1 ? column.components : 0, rows);
    }
  }

  void append(const char* dataset, std::size_t number)
  {
    const auto value = static_cast<std::int64_t>(number);
    this->Out.append(VtkHdfRoot + dataset, std::span(&value, 1));
  }

  void writeColumns(const std::vector<std::string>& names, const std::vector<Column>& columns)
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      this->Out.append(names[i], std::span<const std::byte>(columns[i].bytes));
    }
  }

  VsmReader& Reader;
  Hdf5Output Out;
  FilePositions Positions;
  const std::string PointData = VtkHdfRoot + "PointData", CellData = VtkHdfRoot + "CellData";
  std::vector<std::string> PointNames, CellNames;
  WriteNotes Notes;
  std::vector<std::int64_t> Ends;
  std::vector<std::uint8_t> Bytes;
};

} // namespace

WriteNotes writeVtkHdf(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const ProgressFunction& progressFunction, std::int64_t cells)
{
  Progress progress(progressFunction);
  VsmReader reader(vsm);
  const std::int64_t all = reader.info().cells;
  GridWriter writer(reader, path, (all + cells - 1) / cells);
  MeshPiece piece;
  for (std::int64_t first = 0; first < all; first += cells)
  {
    const std::int64_t end = std::min(all, first + cells);
    reader.readPiece(first, end, piece);
    writer.write(piece);
    progress.update(static_cast<double>(end) / static_cast<double>(all));
  }
  writer.finish();
  return writer.notes();
}

} // namespace smg
