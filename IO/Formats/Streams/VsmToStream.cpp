// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/PagedArray.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamFileWriter.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Text.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** Memory for the last cells of vertices that are in use. */
constexpr std::int64_t LastCellBytes = std::int64_t(8) << 20;

/** The further value of the vertices that SVA and SVB have room for: the first that the mesh has.
 */
std::optional<std::string> scalarOf(const StreamInfo& info)
{
  for (const auto& [name, type] : { std::pair(StreamScalarName, ScalarType::Float32),
         std::pair(StreamIntegerName, ScalarType::Int32) })
  {
    const auto isIt = [name, type](const ColumnSpec& column)
    { return column.name == name && column.type == type && column.components == 1; };
    if (info.cellType == CellType::Tetrahedron && std::ranges::any_of(info.vertexColumns, isIt))
    {
      return name;
    }
  }
  return {};
}

/** The least and largest value of the further float. */
std::array<float, 2> rangeOfScalar(VsmReader& reader)
{
  std::array<float, 2> range{ std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::infinity() };
  Column values;
  constexpr std::int64_t step = 8192;
  for (std::int64_t first = 0; first < reader.info().vertices; first += step)
  {
    reader.readVertexColumn(
      StreamScalarName, first, std::min(step, reader.info().vertices - first), values);
    for (const float value : values.as<float>())
    {
      range = { std::min(range[0], value), std::max(range[1], value) };
    }
  }
  return range;
}

/** Writes the blocks of a mesh stream as the elements of a file. */
class ElementWriter
{
public:
  ElementWriter(VsmReader& reader, const std::filesystem::path& out, StreamFileWriter& writer,
    const StreamFileHeader& header, const std::filesystem::path& scratch)
    : Reader(reader)
    , Out(out)
    , Writer(writer)
    , Header(header)
    , Corners(cornersOf(reader.info().cellType))
    , LastCell(scratch, LastCellBytes)
  {
  }

  void write(const MeshBlock& block)
  {
    std::vector<std::int64_t> last(block.vertices());
    this->Reader.readLastCells(block.firstVertex, last);
    for (std::size_t v = 0; v < last.size(); v++)
    {
      this->LastCell.at(block.firstVertex + std::int64_t(v)) = last[v];
    }
    const auto cells = static_cast<std::int64_t>(block.corners.size()) / this->Corners;
    std::int64_t next = block.firstVertex;
    for (std::int64_t c = 0; c < cells; c++)
    {
      const std::span corners(&block.corners[c * this->Corners], this->Corners);
      unsigned finalMask = 0;
      for (std::size_t k = 0; k < corners.size(); k++)
      {
        if (corners[k] == next)
        {
          this->writeVertex(block, next - block.firstVertex);
          next++;
        }
        const bool isFirst =
          std::find(corners.begin(), corners.begin() + k, corners[k]) == corners.begin() + k;
        if (isFirst && this->LastCell.get(corners[k]) == block.firstCell + c)
        {
          finalMask |= 1U << k;
        }
      }
      this->Writer.cell(corners, finalMask);
    }
    this->LastCell.discardBelow(block.finalized);
  }

  /** The number of vertices so far whose position was rounded. */
  std::int64_t roundedVertices() const { return this->RoundedVertices; }

private:
  void writeVertex(const MeshBlock& block, std::int64_t v)
  {
    const std::span position = std::span(block.positions).subspan(3 * v).first<3>();
    const std::array<float, 3> rounded =
      singlePrecision(position, block.firstVertex + v, this->Out.string());
    this->RoundedVertices += std::equal(rounded.begin(), rounded.end(), position.begin()) ? 0 : 1;
    std::span<const float> floats;
    std::span<const std::int32_t> ints;
    if (this->Header.vertexFloats > 0)
    {
      floats = block.vertexColumns[0].as<float>().subspan(v, 1);
    }
    else if (this->Header.vertexInts > 0)
    {
      ints = block.vertexColumns[0].as<std::int32_t>().subspan(v, 1);
    }
    this->Writer.vertex(rounded, floats, ints);
  }

  VsmReader& Reader;
  const std::filesystem::path& Out;
  StreamFileWriter& Writer;
  const StreamFileHeader& Header;
  int Corners;
  std::int64_t RoundedVertices = 0;
  PagedArray<std::int64_t> LastCell;
};

} // namespace

std::vector<std::string> vsmToStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const std::filesystem::path& scratch,
  const ProgressFunction& progressFunction)
{
  Progress progress(progressFunction);
  VsmReader reader(in);
  const StreamInfo& info = reader.info();
  StreamFileHeader header;
  header.format = *streamFormatOfName(out);
  header.vertices = info.vertices;
  header.cells = info.cells;
  header.bounds = info.bounds;
  // On the columns that were not added by a conversion.
  PlacedColumns placed(ownColumns(info.vertexColumns), ownColumns(info.cellColumns));
  std::vector<std::string> columns;
  if (const std::optional<std::string> scalar = scalarOf(info))
  {
    placed.ofVertices(*scalar, 1, 1);
    columns.push_back(*scalar);
    header.vertexFloats = *scalar == StreamScalarName ? 1 : 0;
    header.vertexInts = 1 - header.vertexFloats;
  }
  if (header.vertexFloats > 0)
  {
    header.floatRanges.push_back(rangeOfScalar(reader));
  }
  const std::unique_ptr<StreamFileWriter> writer = createStreamFile(out, header);
  const std::unique_ptr<MeshSource> source = reader.source(columns, {});
  ElementWriter elements(reader, out, *writer, header, scratch);
  MeshBlock block;
  while (source->next(block))
  {
    elements.write(block);
    progress.update(static_cast<double>(block.firstCell) / static_cast<double>(info.cells));
  }
  writer->finish();
  progress.update(1.0);
  std::vector<std::string> notes = placed.leftOut(out.extension().string());
  if (elements.roundedVertices() > 0)
  {
    notes.push_back("The positions of " +
                    counted(elements.roundedVertices(), "vertex", "vertices") +
                    " were rounded to single precision, which is all that the format has.");
  }
  return notes;
}

} // namespace smg
