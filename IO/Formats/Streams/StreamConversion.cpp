// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamConversion.h"

#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/PagedArray.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Streams/StreamAssembler.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamFileWriter.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

constexpr std::int64_t MinMemory = std::int64_t(8) << 20;

/** Reads the further value of the vertices that SVA and SVB can hold, if any. */
void describeScalar(VsmReader& reader, StreamFileHeader& header)
{
  for (const ColumnSpec& column : reader.info().vertexColumns)
  {
    if (column.name == StreamScalarName && column.type == ScalarType::Float32 &&
        column.components == 1)
    {
      header.vertexFloats = 1;
    }
    if (column.name == StreamIntegerName && column.type == ScalarType::Int32 &&
        column.components == 1)
    {
      header.vertexInts = 1;
    }
  }
  // There is room for one value.
  header.vertexInts = header.vertexFloats > 0 ? 0 : header.vertexInts;
  if (header.vertexFloats > 0)
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
    header.floatRanges.push_back(range);
  }
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
    , LastCell(scratch, MinMemory)
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
    if (this->Header.vertexInts > 0)
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

/** On the columns of a mesh that were not added by a conversion, except for these. */
std::vector<std::string> notesOnOmitted(
  const StreamInfo& info, const std::vector<std::string>& kept, const std::string& suffix)
{
  PlacedColumns columns(ownColumns(info.vertexColumns), ownColumns(info.cellColumns));
  for (const std::string& name : kept)
  {
    columns.ofVertices(name, 1, 1);
  }
  return columns.leftOut(suffix);
}

} // namespace

StreamToVsmResult streamToVsm(const std::filesystem::path& in, const std::filesystem::path& out,
  const StreamToVsmOptions& options)
{
  const std::unique_ptr<StreamFileReader> reader =
    openStreamFile(in, partOf(options.progress, 0.0, 0.99));
  VsmWriter writer(out, StreamAssembler::infoOf(reader->header()),
    { .codec = options.codec, .scratch = options.scratch });
  StreamAssembler assembler(*reader, writer, options.scratch, std::max(options.memory, MinMemory));
  StreamEvent event;
  for (reader->next(event); event.kind != StreamEvent::End; reader->next(event))
  {
    assembler.take(event);
  }
  assembler.finish();
  StreamToVsmResult result;
  result.info = writer.finish();
  result.isolatedVertices = assembler.isolatedVertices();
  Progress(options.progress).update(1.0);
  return result;
}

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
  if (info.cellType == CellType::Tetrahedron)
  {
    describeScalar(reader, header);
  }
  const std::unique_ptr<StreamFileWriter> writer = createStreamFile(out, header);
  std::vector<std::string> columns;
  if (header.vertexFloats + header.vertexInts > 0)
  {
    columns.emplace_back(header.vertexFloats > 0 ? StreamScalarName : StreamIntegerName);
  }
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
  std::vector<std::string> notes = notesOnOmitted(info, columns, out.extension().string());
  if (elements.roundedVertices() > 0)
  {
    notes.push_back("The positions of " +
                    counted(elements.roundedVertices(), "vertex", "vertices") +
                    " were rounded to single precision, which is all that the format has.");
  }
  return notes;
}

} // namespace smg
