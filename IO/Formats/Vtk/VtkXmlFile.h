// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/PositionedFile.h"
#include "IO/Formats/Vtk/InlineArray.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace smg
{

/** What a VTK XML file is to hold. */
struct VtkXmlContent
{
  CellType cellType = CellType::Triangle; ///< with triangles any polygons
  bool doublePositions = true;
  std::int64_t points = 0;
  std::int64_t cells = 0;
  std::int64_t corners = 0; ///< of all cells
  std::vector<ColumnSpec> pointData;
  std::vector<ColumnSpec> cellData;
};

/**
 * A VTK XML file that is written as its data come, in little memory: PolyData if the name ends with
 * .vtp, else an UnstructuredGrid. Each array is within its element, in base64 with 64-bit counts,
 * since with recent versions of Expat many of VTK's readers refuse appended data. As all sizes are
 * known, every array has its place from the start.
 */
class VtkXmlFile
{
public:
  /** Throws Error if the file cannot be made. Without finish(), nothing is left of it. */
  VtkXmlFile(const std::filesystem::path& path, const VtkXmlContent& content);

  /** Appends points with a tuple each of the columns, which are those of the point data. */
  void appendPoints(std::span<const double> positions, const std::vector<Column>& columns);

  /** Appends cells: their corners, and how many of these each has. */
  void appendCells(std::span<const std::int64_t> corners, std::span<const std::uint32_t> sizes,
    const std::vector<Column>& columns);

  /** Ends the file, once everything has come, and gives it its name. Throws Error. */
  void finish();

private:
  void writeFrame(const VtkXmlContent& content);
  void writeText(std::string_view text);
  void place(InlineArray& array);

  const bool PolyData, DoublePositions;
  const CellType CellKind;
  PositionedFile File;
  InlineArray Points, Corners, Ends, Kinds;
  std::vector<InlineArray> PointData, CellData;
  std::vector<InlineArray*> Arrays; ///< those of the file
  std::int64_t End = 0;             ///< where the next text of the frame goes
  std::int64_t LastEnd = 0;         ///< corners of all cells so far
  std::vector<float> Single;
  std::vector<std::int64_t> CellEnds;
  std::vector<std::uint8_t> CellKinds;
};

} // namespace smg
