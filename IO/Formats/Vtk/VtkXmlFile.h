// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/Base64.h"
#include "IO/Files/SequentialOutput.h"
#include "Solver/Core/Progress.h"
#include "smg/Column.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/**
 * An array of a VTK XML file that is written in parts at its position within its element: its
 * number of bytes as UInt64, then its bytes, each a unit of base64. At most two bytes of the data
 * are buffered.
 */
class InlineArray
{
public:
  /** An array of `tuples` tuples. */
  InlineArray(ColumnSpec spec, std::int64_t tuples);

  /** The start tag of the element of the array. */
  std::string tag() const;

  /** Writes the number of bytes at this position of the file; returns the end of the array. */
  std::int64_t begin(PositionedFile& file, std::int64_t at);

  /** Writes the next tuples. Throws Error. */
  void append(PositionedFile& file, std::span<const std::byte> bytes);

  /** Writes the last characters after all tuples. Throws Error. */
  void finish(PositionedFile& file);

private:
  void write(PositionedFile& file, const std::string& text);

  ColumnSpec Spec;
  std::int64_t Bytes;
  std::int64_t At = 0; ///< position of the next characters
  Base64Encoder Encoder;
};

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

/** The name of a scalar type in VTK's XML files: "Int8", "UInt8" ... "Float64". */
SMG_EXPORT std::string vtkXmlTypeName(ScalarType type);

/** The text with the characters that mean something in XML written as entities. */
SMG_EXPORT std::string xmlEscaped(const std::string& text);

/**
 * Writes a mesh stream, which says its numbers of vertices and cells, as one VTK XML file: .vtp for
 * triangles, .vtu for triangles or tetrahedra, with all columns as point and cell data, points in
 * stream order (see VtkXmlFile.h). The data are written as they come, in the memory of a few
 * blocks.
 * @throws Error if the file cannot be written; Cancelled. Nothing is left of the file then.
 */
SMG_EXPORT void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
