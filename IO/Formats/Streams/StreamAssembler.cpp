// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamAssembler.h"

#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <bit>

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

} // namespace

StreamAssembler::StreamAssembler(const StreamFileReader& reader, VsmWriter& writer,
  const std::filesystem::path& scratch, std::int64_t memory)
  : Reader(reader)
  , Header(reader.header())
  , Writer(writer)
  , Corners(cornersOf(cellTypeOf(this->Header.format)))
  , FileVertices(scratch, memory / 2)
  , Values(scratch, memory / 8)
  , Queue(scratch, memory / 4)
  , CellValues(scratch, memory / 16)
  , Until(scratch, memory / 16)
{
  const StreamInfo info = infoOf(this->Header);
  this->Block.vertexColumns = emptyColumns(info.vertexColumns);
  this->Block.cellColumns = emptyColumns(info.cellColumns);
  this->Aside.columns = emptyColumns(info.vertexColumns);
}

StreamInfo StreamAssembler::infoOf(const StreamFileHeader& header)
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

void StreamAssembler::take(const StreamEvent& event)
{
  switch (event.kind)
  {
    case StreamEvent::Vertex:
      this->takeVertex(event);
      break;
    case StreamEvent::Cell:
      this->takeCell(event);
      break;
    case StreamEvent::Finalization:
      this->finalize(event.corners[0]);
      break;
    default:
      return;
  }
  this->deliver();
}

void StreamAssembler::takeVertex(const StreamEvent& event)
{
  const std::int64_t vertex = this->Vertices++;
  this->FileVertices.at(
    vertex) = { event.position, 0, 0, this->Header.postOrder ? this->Cells : Never };
  const int values = this->Header.vertexFloats + this->Header.vertexInts;
  for (int k = 0; k < values; k++)
  {
    const int i = k - this->Header.vertexFloats;
    this->Values.at(vertex * values + k) =
      i < 0 ? std::bit_cast<std::int32_t>(event.floats[k]) : event.ints[i];
  }
}

void StreamAssembler::takeCell(const StreamEvent& event)
{
  for (int k = 0; k < this->Corners; k++)
  {
    const std::int64_t vertex = event.corners[k];
    const bool isFinal = vertex < this->FirstFileVertex ||
                         (vertex < this->Vertices && this->FileVertices.get(vertex).until != Never);
    if (isFinal)
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

void StreamAssembler::finalize(std::int64_t vertex)
{
  if (vertex < this->FirstFileVertex)
  {
    return;
  }
  Vertex& values = this->FileVertices.at(vertex);
  values.until = std::min(values.until, this->Cells);
  if (values.number > 0)
  {
    this->Until.at(values.number - 1) = values.until;
  }
}

void StreamAssembler::deliver()
{
  bool delivered = false;
  while (this->Delivered < this->Cells)
  {
    const std::array<std::int64_t, 4> corners = this->Queue.get(this->Delivered);
    if (*std::max_element(corners.begin(), corners.begin() + this->Corners) >= this->Vertices)
    {
      break;
    }
    this->deliverCell(corners);
    delivered = true;
  }
  if (delivered)
  {
    this->forget();
  }
}

void StreamAssembler::deliverCell(const std::array<std::int64_t, 4>& corners)
{
  for (int k = 0; k < this->Corners; k++)
  {
    const std::int64_t number = this->FileVertices.get(corners[k]).number;
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
std::int64_t StreamAssembler::introduce(std::int64_t vertex)
{
  const std::int64_t id = this->Used++;
  Vertex& values = this->FileVertices.at(vertex);
  values.number = id + 1;
  this->Until.at(id) = values.until;
  MeshBlock& block = this->Block;
  block.positions.insert(block.positions.end(), values.position.begin(), values.position.end());
  this->pushValues(vertex, block.vertexColumns);
  return id;
}

void StreamAssembler::pushValues(std::int64_t vertex, std::vector<Column>& columns)
{
  push(columns[0], vertex);
  const int floats = this->Header.vertexFloats;
  const int count = floats + this->Header.vertexInts;
  for (int k = 0; k < count; k++)
  {
    const std::size_t column = k < floats || floats == 0 ? 1 : 2;
    push(columns[column], this->Values.get(vertex * count + k));
  }
}

void StreamAssembler::forget()
{
  while (this->FirstFileVertex < this->Vertices)
  {
    const Vertex vertex = this->FileVertices.get(this->FirstFileVertex);
    if (vertex.until > this->Delivered)
    {
      break;
    }
    if (vertex.number == 0)
    {
      this->setAside(this->FirstFileVertex);
    }
    this->FirstFileVertex++;
  }
  while (this->FirstStreamVertex < this->Used &&
         this->Until.get(this->FirstStreamVertex) <= this->Delivered)
  {
    this->FirstStreamVertex++;
  }
}

void StreamAssembler::setAside(std::int64_t vertex)
{
  const std::array<float, 3> position = this->FileVertices.get(vertex).position;
  IsolatedVertices& aside = this->Aside;
  aside.ids.push_back(vertex);
  aside.positions.insert(aside.positions.end(), position.begin(), position.end());
  this->pushValues(vertex, aside.columns);
  this->AsideCount++;
  if (std::ssize(aside.ids) == BlockCells)
  {
    this->flushIsolated();
  }
}

void StreamAssembler::flushIsolated()
{
  this->Writer.isolated(this->Aside.ids, this->Aside.positions, this->Aside.columns);
  this->Aside.ids.clear();
  this->Aside.positions.clear();
  clearTuples(this->Aside.columns);
}

void StreamAssembler::flush()
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
  this->Values.discardBelow(
    this->FirstFileVertex * (this->Header.vertexFloats + this->Header.vertexInts));
  this->Queue.discardBelow(this->Delivered);
  this->CellValues.discardBelow(this->Delivered * this->Header.cellInts);
  this->Until.discardBelow(this->FirstStreamVertex);
}

void StreamAssembler::finish()
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
    if (this->FileVertices.get(vertex).number == 0)
    {
      this->setAside(vertex);
    }
  }
  this->flushIsolated();
}

} // namespace smg
