// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/PagedArray.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Mesh/Columns.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <memory>

namespace smg
{

namespace
{

/** Cells that are delivered to the writer at once. */
constexpr std::int64_t BlockCells = 8192;

template <class T>
void push(Column& column, T value)
{
  const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
  column.bytes.insert(column.bytes.end(), bytes, bytes + sizeof(T));
}

/**
 * Converts the elements of a streaming mesh file to a compact mesh stream: cells in the order of
 * the file, each as soon as all of its vertices are known, vertices numbered by first use. Vertices
 * of no cell are stored in the table of the isolated ones.
 *
 * The data of waiting vertices and cells are stored in pages (PagedArray.h), which are released
 * when their vertices are final. All else is a block of cells with its vertices, and as many
 * isolated vertices: memory that does not depend on the file.
 */
class StreamAssembler
{
public:
  /** `memory`: bytes for the pages. */
  StreamAssembler(const StreamFileReader& reader, VsmWriter& writer,
    const std::filesystem::path& scratch, std::int64_t memory)
    : Reader(reader)
    , Header(reader.header())
    , Writer(writer)
    , Corners(cornersOf(cellTypeOf(this->Header.format)))
    , Values(this->Header.vertexFloats + this->Header.vertexInts)
    , FileVertices(scratch, memory / 2)
    , VertexValues(scratch, memory / 8)
    , Queue(scratch, memory / 4)
    , CellValues(scratch, memory / 16)
    , LastUse(scratch, memory / 16)
  {
    const StreamInfo info = streamInfoOf(this->Header);
    this->Block.vertexColumns = emptyColumns(info.vertexColumns);
    this->Block.cellColumns = emptyColumns(info.cellColumns);
    this->Aside.columns = emptyColumns(info.vertexColumns);
  }

  /** Adds the next element of the file. */
  void take(const StreamEvent& event)
  {
    event.kind == StreamEvent::Vertex ? this->takeVertex(event)
    : event.kind == StreamEvent::Cell ? this->takeCell(event)
                                      : this->finalize(event.corners[0]);
    this->deliver();
  }

  /** To be called at the end of the file. */
  void finish()
  {
    if (this->Delivered < this->Cells)
    {
      this->Reader.fail("the file ends with " + std::to_string(this->Vertices) +
                        " vertices, but cell " + std::to_string(this->Delivered + 1) +
                        " uses others: it is truncated or damaged.");
    }
    if (this->Delivered > this->Block.firstCell)
    {
      this->flush();
    }
    // Those never declared final.
    for (std::int64_t vertex = this->FirstFileVertex; this->AsideCount < this->isolatedVertices();
         vertex++)
    {
      if (this->FileVertices.get(vertex).streamIndexPlus1 == 0)
      {
        this->setAside(vertex);
      }
    }
    this->flushIsolated();
  }

  std::int64_t isolatedVertices() const { return this->Vertices - this->Used; }

private:
  static constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::max();

  /** A vertex of the file. */
  struct Vertex
  {
    std::array<float, 3> position;
    std::uint32_t unused;
    std::int64_t streamIndexPlus1; ///< its stream index + 1, or 0 if no delivered cell uses it
    std::int64_t lastUse;          ///< needed until this many cells are delivered, or always
  };
  static_assert(sizeof(Vertex) == 32);

  void takeVertex(const StreamEvent& event)
  {
    const std::int64_t vertex = this->Vertices++;
    this->FileVertices.at(
      vertex) = { event.position, 0, 0, this->Header.postOrder ? this->Cells : Never };
    std::int64_t place = vertex * this->Values;
    for (const float value : event.floats)
    {
      this->VertexValues.at(place++) = std::bit_cast<std::int32_t>(value);
    }
    for (const std::int32_t value : event.ints)
    {
      this->VertexValues.at(place++) = value;
    }
  }

  void takeCell(const StreamEvent& event)
  {
    for (int k = 0; k < this->Corners; k++)
    {
      const std::int64_t vertex = event.corners[k];
      if (vertex < this->FirstFileVertex ||
          (vertex < this->Vertices && this->FileVertices.get(vertex).lastUse != Never))
      {
        this->Reader.fail("the cell uses vertex " + std::to_string(vertex + 1) +
                          " of the file, which was final before.");
      }
    }
    const std::int64_t cell = this->Cells++;
    this->Queue.at(cell) = event.corners;
    for (int k = 0; k < this->Header.cellInts; k++)
    {
      this->CellValues.at(cell * this->Header.cellInts + k) = event.ints[k];
    }
    for (int k = 0; k < this->Corners; k++)
    {
      if ((event.finalMask >> k & 1U) != 0)
      {
        this->finalize(event.corners[k]);
      }
    }
  }

  void finalize(std::int64_t vertex)
  {
    if (vertex < this->FirstFileVertex)
    {
      return;
    }
    Vertex& values = this->FileVertices.at(vertex);
    values.lastUse = std::min(values.lastUse, this->Cells);
    if (values.streamIndexPlus1 > 0)
    {
      this->LastUse.at(values.streamIndexPlus1 - 1) = values.lastUse;
    }
  }

  /** Delivers the cells at the head of the queue whose vertices are complete. */
  void deliver()
  {
    const std::int64_t before = this->Delivered;
    while (this->Delivered < this->Cells)
    {
      const std::array<std::int64_t, 4> corners = this->Queue.get(this->Delivered);
      if (*std::max_element(corners.begin(), corners.begin() + this->Corners) >= this->Vertices)
      {
        break;
      }
      this->deliverCell(corners);
    }
    if (this->Delivered > before)
    {
      this->forget();
    }
  }

  void deliverCell(const std::array<std::int64_t, 4>& corners)
  {
    for (int k = 0; k < this->Corners; k++)
    {
      const std::int64_t number = this->FileVertices.get(corners[k]).streamIndexPlus1;
      this->Block.corners.push_back(number > 0 ? number - 1 : this->introduce(corners[k]));
    }
    push(this->Block.cellColumns[0], this->Delivered);
    for (int k = 0; k < this->Header.cellInts; k++)
    {
      push(this->Block.cellColumns[1],
        this->CellValues.get(this->Delivered * this->Header.cellInts + k));
    }
    this->Delivered++;
    if (this->Delivered - this->Block.firstCell == BlockCells)
    {
      this->flush();
    }
  }

  /** Assigns the next stream index to a vertex. */
  std::int64_t introduce(std::int64_t vertex)
  {
    const std::int64_t id = this->Used++;
    Vertex& values = this->FileVertices.at(vertex);
    values.streamIndexPlus1 = id + 1;
    this->LastUse.at(id) = values.lastUse;
    this->append(vertex, values.position, this->Block.positions, this->Block.vertexColumns);
    return id;
  }

  /** Appends a vertex, its index in the file and its further values. */
  void append(std::int64_t vertex, const std::array<float, 3>& position,
    std::vector<double>& positions, std::vector<Column>& columns)
  {
    positions.insert(positions.end(), position.begin(), position.end());
    push(columns[0], vertex);
    const int floats = this->Header.vertexFloats;
    for (int k = 0; k < this->Values; k++)
    {
      const std::size_t column = k < floats || floats == 0 ? 1 : 2;
      push(columns[column], this->VertexValues.get(vertex * this->Values + k));
    }
  }

  /** Releases data that are not needed any more. */
  void forget()
  {
    while (this->FirstFileVertex < this->Vertices)
    {
      const Vertex vertex = this->FileVertices.get(this->FirstFileVertex);
      if (vertex.lastUse > this->Delivered)
      {
        break;
      }
      if (vertex.streamIndexPlus1 == 0)
      {
        this->setAside(this->FirstFileVertex);
      }
      this->FirstFileVertex++;
    }
    while (this->FirstStreamVertex < this->Used &&
           this->LastUse.get(this->FirstStreamVertex) <= this->Delivered)
    {
      this->FirstStreamVertex++;
    }
  }

  /** Takes a vertex that no cell uses. */
  void setAside(std::int64_t vertex)
  {
    IsolatedVertices& aside = this->Aside;
    aside.ids.push_back(vertex);
    this->append(vertex, this->FileVertices.get(vertex).position, aside.positions, aside.columns);
    this->AsideCount++;
    if (std::ssize(aside.ids) == BlockCells)
    {
      this->flushIsolated();
    }
  }

  void flushIsolated()
  {
    this->Writer.isolated(this->Aside.ids, this->Aside.positions, this->Aside.columns);
    this->Aside.ids.clear();
    this->Aside.positions.clear();
    clearTuples(this->Aside.columns);
  }

  void flush()
  {
    this->forget();
    this->Block.finalized = this->FirstStreamVertex;
    this->Writer.append(this->Block);
    this->Block.firstVertex = this->Used;
    this->Block.firstCell = this->Delivered;
    this->Block.positions.clear();
    this->Block.corners.clear();
    clearTuples(this->Block.vertexColumns);
    clearTuples(this->Block.cellColumns);
    this->FileVertices.discardBelow(this->FirstFileVertex);
    this->VertexValues.discardBelow(this->FirstFileVertex * this->Values);
    this->Queue.discardBelow(this->Delivered);
    this->CellValues.discardBelow(this->Delivered * this->Header.cellInts);
    this->LastUse.discardBelow(this->FirstStreamVertex);
  }

  const StreamFileReader& Reader;
  const StreamFileHeader& Header;
  VsmWriter& Writer;
  const int Corners;
  const std::int64_t Values; ///< further ones of a vertex

  std::int64_t Vertices = 0;  ///< that have come
  std::int64_t Cells = 0;     ///< that have come
  std::int64_t Delivered = 0; ///< cells delivered
  std::int64_t Used = 0;      ///< vertices delivered

  PagedArray<Vertex> FileVertices;               ///< by place in the file
  PagedArray<std::int32_t> VertexValues;         ///< further values of these, bits of floats too
  PagedArray<std::array<std::int64_t, 4>> Queue; ///< corners of the cells, by place in the file
  PagedArray<std::int32_t> CellValues;
  PagedArray<std::int64_t> LastUse; ///< like Vertex::lastUse, by stream index
  std::int64_t FirstFileVertex = 0; ///< earlier vertices are not needed any more
  std::int64_t FirstStreamVertex = 0;

  MeshBlock Block; ///< the current block
  IsolatedVertices Aside;
  std::int64_t AsideCount = 0; ///< vertices set aside
};

} // namespace

StreamInfo streamInfoOf(const StreamFileHeader& header)
{
  StreamInfo info;
  info.cellType = cellTypeOf(header.format);
  info.doublePositions = false;
  info.vertexColumns.push_back({ OriginalIdName, ScalarType::Int64, 1 });
  if (header.vertexFloats > 0)
  {
    info.vertexColumns.push_back({ StreamScalarName, ScalarType::Float32, header.vertexFloats });
  }
  if (header.vertexInts > 0)
  {
    info.vertexColumns.push_back({ StreamIntegerName, ScalarType::Int32, header.vertexInts });
  }
  info.cellColumns.push_back({ OriginalCellIdName, ScalarType::Int64, 1 });
  if (header.cellInts > 0)
  {
    info.cellColumns.push_back({ StreamIntegerName, ScalarType::Int32, header.cellInts });
  }
  return info;
}

StreamToVsmResult streamToVsm(const std::filesystem::path& in, const std::filesystem::path& out,
  const StreamToVsmOptions& options)
{
  constexpr std::int64_t minMemory = std::int64_t(8) << 20;
  const std::unique_ptr<StreamFileReader> reader =
    openStreamFile(in, partOf(options.progress, 0.0, 0.99));
  VsmWriter writer(
    out, streamInfoOf(reader->header()), { .codec = Codec::Lz4, .scratch = options.scratch });
  StreamAssembler assembler(*reader, writer, options.scratch, std::max(options.memory, minMemory));
  StreamEvent event;
  for (reader->next(event); event.kind != StreamEvent::End; reader->next(event))
  {
    assembler.take(event);
  }
  assembler.finish();
  StreamToVsmResult result{ writer.finish(), assembler.isolatedVertices() };
  Progress(options.progress).update(1.0);
  return result;
}

} // namespace smg
