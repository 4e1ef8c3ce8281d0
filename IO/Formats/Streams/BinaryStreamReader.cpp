// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/BinaryStreamReader.h"

#include "IO/Formats/Streams/BinaryStreamHeader.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace smg
{

BinaryStreamReader::BinaryStreamReader(const std::filesystem::path& path, StreamFormat format)
  : StreamFileReader(path)
  , Corners(cornersOf(cellTypeOf(format)))
  , ElementBytes(4 * this->Corners)
{
  BinaryStreamHeader begin = readBinaryStreamHeader(this->Input.file(), format);
  this->Header = std::move(begin.header);
  this->Order = begin.order;
  this->ElementOffset = begin.bodyOffset;
  this->Input.moveTo(begin.bodyOffset);
  if (this->nextBlock())
  {
    this->Header.postOrder = (this->Kinds & 1) == 0;
  }
}

std::string BinaryStreamReader::place() const
{
  return "element " + std::to_string(this->Element) + " at byte " +
         std::to_string(this->ElementOffset);
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
    bytes.size() < 4 ? 0 : numberAt<std::uint32_t>(bytes.data(), this->Order);
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

bool BinaryStreamReader::read(StreamEvent& event)
{
  if (this->Left == 0 && !this->nextBlock())
  {
    return false;
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
  return true;
}

void BinaryStreamReader::readVertex(const std::byte* element, StreamEvent& event)
{
  event.kind = StreamEvent::Vertex;
  for (float& x : event.position)
  {
    x = numberAt<float>(element, this->Order);
    element += 4;
    if (!std::isfinite(x))
    {
      this->fail("a coordinate is not a finite number.");
    }
  }
  for (int k = 0; k < this->Header.vertexFloats; k++, element += 4)
  {
    event.floats.push_back(numberAt<float>(element, this->Order));
  }
  for (int k = 0; k < this->Header.vertexInts; k++, element += 4)
  {
    event.ints.push_back(numberAt<std::int32_t>(element, this->Order));
  }
}

void BinaryStreamReader::readCell(const std::byte* element, StreamEvent& event)
{
  event.kind = StreamEvent::Cell;
  const StreamFileHeader& header = this->Header;
  const std::int64_t given = header.vertices >= 0 ? header.vertices : INT32_MAX;
  const std::int64_t most =
    header.postOrder ? std::min(given, this->Input.size() / std::int64_t(this->ElementBytes))
                     : this->Vertices;
  for (int k = 0; k < this->Corners; k++, element += 4)
  {
    const std::int64_t index = numberAt<std::int32_t>(element, this->Order);
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
}

} // namespace smg
