// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/BinaryStreamReader.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>

namespace smg
{

BinaryStreamReader::BinaryStreamReader(const std::filesystem::path& path, StreamFormat format)
  : Input(path)
  , Begin(readBinaryStreamHeader(this->Input.file(), format))
  , Corners(cornersOf(cellTypeOf(format)))
  , ElementBytes(4 * this->Corners)
  , ElementOffset(this->Begin.bodyOffset)
{
  this->Input.moveTo(this->Begin.bodyOffset);
  if (this->nextBlock())
  {
    this->Begin.header.postOrder = (this->Kinds & 1) == 0;
  }
}

void BinaryStreamReader::fail(const std::string& what) const
{
  throw Error(this->Input.name() + ": " + this->place() + ": " + what);
}

std::string BinaryStreamReader::place() const
{
  return "element " + std::to_string(this->Element) + " at byte " +
         std::to_string(this->ElementOffset);
}

double BinaryStreamReader::fraction() const
{
  return this->Input.size() > 0
           ? static_cast<double>(this->Input.position()) / static_cast<double>(this->Input.size())
           : 1.0;
}

bool BinaryStreamReader::nextBlock()
{
  const std::span<const std::byte> bytes =
    this->Input.peek(4 + BinaryBlockElements * this->ElementBytes);
  if (bytes.empty())
  {
    return false;
  }
  this->Left = bytes.size() < 4 ? 0 : (bytes.size() - 4) / this->ElementBytes;
  const std::uint32_t kinds =
    bytes.size() < 4 ? 0 : numberAt<std::uint32_t>(bytes.data(), this->Begin.order);
  if (bytes.size() != 4 + this->Left * this->ElementBytes ||
      (this->Left < BinaryBlockElements && (kinds >> this->Left) != 0))
  {
    this->ElementOffset = this->Input.position();
    this->Element++;
    this->fail("the block that begins here is not complete: the file is truncated or damaged.");
  }
  this->Kinds = kinds;
  this->Input.skip(4);
  return this->Left > 0;
}

void BinaryStreamReader::next(StreamEvent& event)
{
  event.floats.clear();
  event.ints.clear();
  event.finalMask = 0;
  if (this->Left == 0 && !this->nextBlock())
  {
    this->checkEnd();
    event.kind = StreamEvent::End;
    return;
  }
  this->Element++;
  this->ElementOffset = this->Input.position();
  const std::byte* const element = this->Input.peek(this->ElementBytes).data();
  if ((this->Kinds & 1) != 0)
  {
    this->readVertex(element, event);
  }
  else
  {
    this->readCell(element, event);
  }
  this->Input.skip(this->ElementBytes);
  this->Kinds >>= 1;
  this->Left--;
}

void BinaryStreamReader::readVertex(const std::byte* element, StreamEvent& event)
{
  event.kind = StreamEvent::Vertex;
  for (float& x : event.position)
  {
    x = numberAt<float>(element, this->Begin.order);
    element += 4;
    if (!std::isfinite(x))
    {
      this->fail("a coordinate is not a finite number.");
    }
  }
  for (int k = 0; k < this->Begin.header.vertexFloats; k++, element += 4)
  {
    event.floats.push_back(numberAt<float>(element, this->Begin.order));
  }
  for (int k = 0; k < this->Begin.header.vertexInts; k++, element += 4)
  {
    event.ints.push_back(numberAt<std::int32_t>(element, this->Begin.order));
  }
  this->Vertices++;
}

void BinaryStreamReader::readCell(const std::byte* element, StreamEvent& event)
{
  event.kind = StreamEvent::Cell;
  const StreamFileHeader& header = this->Begin.header;
  const std::int64_t given = header.vertices >= 0 ? header.vertices : INT32_MAX;
  const std::int64_t most =
    header.postOrder ? std::min(given, this->Input.size() / std::int64_t(this->ElementBytes))
                     : this->Vertices;
  for (int k = 0; k < this->Corners; k++, element += 4)
  {
    const std::int64_t index = numberAt<std::int32_t>(element, this->Begin.order);
    const bool final = index < 0;
    const std::int64_t vertex = final ? this->Vertices + index : index - 1;
    if (index == 0 || (final && header.postOrder) || vertex < 0 || vertex >= most)
    {
      this->fail("the cell has index " + std::to_string(index) + " after " +
                 std::to_string(this->Vertices) + " vertices, which is no vertex of this file" +
                 (header.postOrder ? "." : " so far."));
    }
    event.corners[k] = vertex;
    event.finalMask |= final ? 1U << k : 0U;
  }
  this->Cells++;
}

void BinaryStreamReader::checkEnd() const
{
  const StreamFileHeader& header = this->Begin.header;
  const bool vertices = header.vertices >= 0 && this->Vertices != header.vertices;
  const bool cells = header.cells >= 0 && this->Cells != header.cells;
  if (vertices || cells)
  {
    this->fail(
      "the file ends here with " + std::to_string(vertices ? this->Vertices : this->Cells) +
      (vertices ? " vertices" : " cells") + ", but its header says " +
      std::to_string(vertices ? header.vertices : header.cells) + ": it is truncated or damaged.");
  }
  if (this->Cells == 0)
  {
    this->fail("the file ends without a cell.");
  }
}

} // namespace smg
