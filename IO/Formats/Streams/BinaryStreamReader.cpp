// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/BinaryStreamReader.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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
                 std::to_string(this->Vertices) + " vertices, which is not a vertex of this file" +
                 (header.postOrder ? "." : " so far."));
    }
    event.corners[k] = vertex;
    event.finalMask |= final ? 1U << k : 0U;
  }
}

namespace
{

/** The beginning of a file that is invalid in the byte order in which it is read. */
class Nonsense
{
};

/** The same, perhaps only since it has more comments than are read. */
class TooLong : public Nonsense
{
};

/** The same, since the file ends before what it says. */
class TooShort : public Nonsense
{
public:
  explicit TooShort(std::string sentence)
    : Sentence(std::move(sentence))
  {
  }
  const std::string& sentence() const { return this->Sentence; }

private:
  std::string Sentence;
};

/** Reads numbers from a file in one byte order. */
class Cursor
{
public:
  Cursor(const FileDescriptor& file, std::int64_t offset, std::endian order)
    : File(file)
    , Offset(offset)
    , Order(order)
  {
  }

  template <class T>
  T take()
  {
    std::byte bytes[4];
    this->bytes(bytes);
    return numberAt<T>(bytes, this->Order);
  }

  bool takeFlag()
  {
    std::byte flag[1];
    this->bytes(flag);
    if (flag[0] > std::byte{ 1 })
    {
      throw Nonsense();
    }
    return flag[0] == std::byte{ 1 };
  }

  std::string takeText(std::int32_t length)
  {
    if (length < 0)
    {
      throw Nonsense();
    }
    this->TextBytes += static_cast<std::int64_t>(sizeof(std::string)) + length;
    if (this->TextBytes > StreamFileHeader::MaxCommentBytes)
    {
      throw TooLong();
    }
    if (length > this->File.size() - this->Offset)
    {
      this->failAtEnd();
    }
    std::string text(length, '\0');
    this->bytes(std::as_writable_bytes(std::span(text)));
    return text;
  }

  void skip(std::int64_t count) { this->Offset += count; }
  std::int64_t offset() const { return this->Offset; }

private:
  [[noreturn]] void failAtEnd() const
  {
    throw TooShort("byte " + std::to_string(this->File.size()) + ": the file ends in its header.");
  }

  void bytes(std::span<std::byte> to)
  {
    if (this->File.readSome(this->Offset, to) != to.size())
    {
      this->failAtEnd();
    }
    this->Offset += static_cast<std::int64_t>(to.size());
  }

  const FileDescriptor& File;
  std::int64_t Offset;
  std::endian Order;
  std::int64_t TextBytes = 0;
};

void takeBounds(Cursor& cursor, StreamFileHeader& header)
{
  std::array<double, 6> bounds{};
  for (int upper = 0; upper < 2; upper++)
  {
    for (int axis = 0; axis < 3; axis++)
    {
      bounds[2 * axis + upper] = cursor.take<float>();
    }
    cursor.skip(4 * header.vertexFloats);
  }
  if (std::all_of(bounds.begin(), bounds.end(), [](double x) { return std::isfinite(x); }))
  {
    header.bounds = bounds;
  }
}

BinaryStreamHeader readAs(const FileDescriptor& file, StreamFormat format, std::endian order)
{
  BinaryStreamHeader result;
  StreamFileHeader& header = result.header;
  header.format = format;
  result.order = order;
  Cursor cursor(file, 4, order);
  const auto comments = cursor.take<std::int32_t>();
  if (comments < 0 || comments > file.size() / 4)
  {
    throw Nonsense();
  }
  for (std::int32_t i = 0; i < comments; i++)
  {
    header.comments.push_back(cursor.takeText(cursor.take<std::int32_t>()));
  }
  header.vertices = cursor.take<std::int32_t>();
  header.cells = cursor.take<std::int32_t>();
  if (format == StreamFormat::Svb)
  {
    const auto floats = cursor.take<std::int32_t>();
    header.vertexInts = cursor.take<std::int32_t>();
    // A vertex has four words.
    if (floats < 3 || floats > 4 || header.vertexInts < 0 || floats + header.vertexInts > 4)
    {
      throw Nonsense();
    }
    header.vertexFloats = floats - 3;
  }
  if (cursor.takeFlag())
  {
    takeBounds(cursor, header);
  }
  if (header.vertexInts > 0 && cursor.takeFlag())
  {
    cursor.skip(2 * 4 * header.vertexInts);
  }
  const std::int64_t elementBytes = 4 * cornersOf(cellTypeOf(format));
  const std::int64_t most = (file.size() - cursor.offset()) / elementBytes;
  if (header.vertices < -1 || header.cells < -1)
  {
    throw Nonsense();
  }
  if (header.vertices > most || header.cells > most)
  {
    throw TooShort("byte " + std::to_string(cursor.offset()) +
                   ": the file ends too early for the counts of its header, " +
                   std::to_string(header.vertices) + " vertices and " +
                   std::to_string(header.cells) + " cells: it is truncated or damaged.");
  }
  result.bodyOffset = cursor.offset();
  return result;
}

/** Whether the elements of the first block can be valid. */
bool firstBlockMakesSense(const FileDescriptor& file, const BinaryStreamHeader& begin)
{
  const int corners = cornersOf(cellTypeOf(begin.header.format));
  const int elementBytes = 4 * corners;
  std::byte block[4 + BinaryBlockElements * 16];
  const std::size_t bytes = file.readSome(begin.bodyOffset, block);
  const std::int64_t most = file.size() / elementBytes;
  if (bytes < 4)
  {
    return false;
  }
  const auto kinds = numberAt<std::uint32_t>(block, begin.order);
  const std::byte* element = block + 4;
  for (int k = 0; k < BinaryBlockElements && element + elementBytes <= block + bytes; k++)
  {
    for (int j = 0; j < corners; j++)
    {
      const std::byte* word = element + 4 * std::ptrdiff_t(j);
      if ((kinds >> k & 1) != 0)
      {
        const auto x = numberAt<float>(word, begin.order);
        if (j < 3 &&
            (!std::isfinite(x) || (x != 0 && (std::abs(x) < 1e-30F || std::abs(x) > 1e30F))))
        {
          return false;
        }
      }
      else if (const auto index = numberAt<std::int32_t>(word, begin.order);
               index == 0 || index > most || index < -most)
      {
        return false;
      }
    }
    element += elementBytes;
  }
  return true;
}

} // namespace

BinaryStreamHeader readBinaryStreamHeader(const FileDescriptor& file, StreamFormat format)
{
  std::byte first[4] = {};
  const std::size_t there = file.readSome(0, first);
  const std::string name = file.path().string();
  if (there < sizeof(first))
  {
    throw Error(name + ": byte " + std::to_string(there) + ": the file ends in its header.");
  }
  if (first[1] > std::byte{ 1 } || first[2] != std::byte{} || first[3] != std::byte{})
  {
    throw Error(name + ": byte 1: the header of a " + std::string(nameOf(format)) +
                " file goes on otherwise: this is another format, or the file is damaged.");
  }
  const bool saysBig = first[1] == std::byte{ 1 };
  std::vector<BinaryStreamHeader> candidates;
  bool isTooLong = false;
  std::string sentenceOnEnd; // in the order that the file says
  for (const bool isBig : { saysBig, !saysBig })
  {
    try
    {
      candidates.push_back(readAs(file, format, isBig ? std::endian::big : std::endian::little));
    }
    catch (const TooLong&)
    {
      isTooLong = true;
    }
    catch (const TooShort& end)
    {
      sentenceOnEnd = isBig == saysBig ? end.sentence() : sentenceOnEnd;
    }
    catch (const Nonsense&)
    {
    }
  }
  if (candidates.empty() && isTooLong)
  {
    throw Error(name + ": byte 4: the comments of the header have more than 1 MiB, which is more "
                       "than is read: remove some of them, if the file is not damaged.");
  }
  if (candidates.empty() && !sentenceOnEnd.empty())
  {
    throw Error(name + ": " + sentenceOnEnd);
  }
  if (candidates.empty())
  {
    throw Error(name + ": byte 4: the header makes no sense in either byte order: the file is "
                       "truncated or damaged.");
  }
  const bool useOther = candidates.size() == 2 && !firstBlockMakesSense(file, candidates[0]) &&
                        firstBlockMakesSense(file, candidates[1]);
  return candidates[useOther ? 1 : 0];
}

} // namespace smg
