// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/BinaryInput.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "smg/Error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

/** The beginning of a SMB or SVB file, and the byte order of its data. */
struct BinaryBegin
{
  StreamFileHeader header;
  std::endian order = std::endian::native;
  std::size_t body = 0; ///< offset of the first block
};

/** Why a header is not one in the byte order in which it is read. */
struct BadHeader
{
  /** In ascending priority: of a header that is valid in neither order, the highest is reported. */
  enum Kind
  {
    Inconsistent,
    Truncated, ///< tells something only in the order that the file says
    TooLong    ///< perhaps only since it has more comments than are read
  };
  Kind kind;
  std::string sentence;
};

void require(bool makesSense)
{
  if (!makesSense)
  {
    throw BadHeader{ BadHeader::Inconsistent, {} };
  }
}

bool takeFlag(BinaryInput& input)
{
  const auto flag = input.take<std::uint8_t>();
  require(flag <= 1);
  return flag == 1;
}

void takeComments(InputFile& file, BinaryInput& input, std::vector<std::string>& comments)
{
  const auto count = input.take<std::int32_t>();
  require(count >= 0 && static_cast<std::size_t>(count) <= file.size() / 4);
  std::int64_t bytes = 0;
  for (std::int32_t i = 0; i < count; i++)
  {
    const auto length = input.take<std::int32_t>();
    require(length >= 0);
    bytes += static_cast<std::int64_t>(sizeof(std::string)) + length;
    if (bytes > StreamFileHeader::MaxCommentBytes)
    {
      throw BadHeader{ BadHeader::TooLong,
        "byte 4: the comments of the header have more than 1 MiB, which is more than is read: "
        "remove some of them, if the file is not damaged." };
    }
    const std::size_t begin = input.offset();
    const auto size = static_cast<std::size_t>(length);
    comments.emplace_back(file.at(begin, size).substr(0, size));
    input.moveTo(begin + size);
  }
}

void takeBounds(BinaryInput& input, StreamFileHeader& header)
{
  std::array<double, 6> bounds{};
  for (int upper = 0; upper < 2; upper++)
  {
    for (int axis = 0; axis < 3; axis++)
    {
      bounds[2 * axis + upper] = input.take<float>();
    }
    input.skip(4 * static_cast<std::size_t>(header.vertexFloats));
  }
  if (std::ranges::all_of(bounds, [](double x) { return std::isfinite(x); }))
  {
    header.bounds = bounds;
  }
}

/** Throws BadHeader; MeshError where the file ends. */
BinaryBegin readAs(InputFile& file, StreamFormat format, std::endian order)
{
  BinaryBegin result;
  result.order = order;
  StreamFileHeader& header = result.header;
  header.format = format;
  BinaryInput input(file, 4, order);
  takeComments(file, input, header.comments);
  header.vertices = input.take<std::int32_t>();
  header.cells = input.take<std::int32_t>();
  if (format == StreamFormat::Svb)
  {
    const auto floats = input.take<std::int32_t>();
    header.vertexInts = input.take<std::int32_t>();
    // A vertex has four words.
    require(
      floats >= 3 && floats <= 4 && header.vertexInts >= 0 && header.vertexInts <= 4 - floats);
    header.vertexFloats = floats - 3;
  }
  if (takeFlag(input))
  {
    takeBounds(input, header);
  }
  if (header.vertexInts > 0 && takeFlag(input))
  {
    input.skip(2 * 4 * static_cast<std::size_t>(header.vertexInts));
  }
  require(header.vertices >= -1 && header.cells >= -1);
  const std::int64_t elementBytes = 4 * cornersOf(cellTypeOf(format));
  const std::int64_t most = static_cast<std::int64_t>(input.left()) / elementBytes;
  if (header.vertices > most || header.cells > most)
  {
    throw BadHeader{ BadHeader::Truncated,
      "byte " + std::to_string(input.offset()) +
        ": the file ends too early for the counts of its header, " +
        std::to_string(header.vertices) + " vertices and " + std::to_string(header.cells) +
        " cells: it is truncated or damaged." };
  }
  result.body = input.offset();
  return result;
}

/** Whether the elements of the first block can be valid. */
bool firstBlockMakesSense(InputFile& file, const BinaryBegin& begin)
{
  const int corners = cornersOf(cellTypeOf(begin.header.format));
  const std::size_t elementBytes = 4 * static_cast<std::size_t>(corners);
  const auto most = static_cast<std::int64_t>(file.size() / elementBytes);
  BinaryInput block(file, begin.body, begin.order);
  if (block.left() < sizeof(std::uint32_t))
  {
    return false;
  }
  const auto kinds = block.take<std::uint32_t>();
  for (int k = 0; k < BinaryBlockElements && block.left() >= elementBytes; k++)
  {
    for (int j = 0; j < corners; j++)
    {
      if ((kinds >> k & 1) != 0)
      {
        const auto x = block.take<float>();
        if (j < 3 &&
            (!std::isfinite(x) || (x != 0 && (std::abs(x) < 1e-30F || std::abs(x) > 1e30F))))
        {
          return false;
        }
      }
      else if (const auto index = block.take<std::int32_t>();
               index == 0 || index > most || index < -most)
      {
        return false;
      }
    }
  }
  return true;
}

/**
 * Reads the beginning of a file. The byte for the byte order is unreliable, since some programs
 * write a wrong one. Therefore the order is the one in which the header and the first block are
 * valid; if both are, the byte decides. Throws Error.
 */
BinaryBegin readBegin(InputFile& file, StreamFormat format)
{
  const auto refuse = [&file](const std::string& what) { throw Error(file.name() + ": " + what); };
  const std::string endsInHeader =
    "byte " + std::to_string(file.size()) + ": the file ends in its header.";
  const std::string first(file.at(0, 4).substr(0, 4));
  if (first.size() < 4)
  {
    refuse(endsInHeader);
  }
  const auto flag = static_cast<unsigned char>(first[1]);
  if (flag > 1 || first[2] != 0 || first[3] != 0)
  {
    refuse("byte 1: the header of a " + std::string(nameOf(format)) +
           " file goes on otherwise: this is another format, or the file is damaged.");
  }
  std::vector<BinaryBegin> candidates;
  BadHeader told{ BadHeader::Inconsistent,
    "byte 4: the header makes no sense in either byte order: the file is truncated or damaged." };
  for (const bool isBig : { flag == 1, flag == 0 })
  {
    const auto note = [&](const BadHeader& bad)
    {
      const bool tells = bad.kind != BadHeader::Truncated || isBig == (flag == 1);
      told = tells && bad.kind > told.kind ? bad : told;
    };
    try
    {
      candidates.push_back(readAs(file, format, isBig ? std::endian::big : std::endian::little));
    }
    catch (const BadHeader& bad)
    {
      note(bad);
    }
    catch (const MeshError&)
    {
      note({ BadHeader::Truncated, endsInHeader });
    }
  }
  if (candidates.empty())
  {
    refuse(told.sentence);
  }
  const bool useOther = candidates.size() == 2 && !firstBlockMakesSense(file, candidates[0]) &&
                        firstBlockMakesSense(file, candidates[1]);
  return candidates[useOther ? 1 : 0];
}

/** Reads SMB and SVB. */
class BinaryStreamReader : public StreamFileReader
{
public:
  BinaryStreamReader(
    const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress)
    : StreamFileReader(path, format, progress)
    , ElementBytes(4 * static_cast<std::size_t>(this->Corners))
    , Body(this->Input, 0, std::endian::native)
  {
    BinaryBegin begin = readBegin(this->Input, format);
    this->Header = std::move(begin.header);
    this->Offset = begin.body;
    this->Body.setByteOrder(begin.order);
    this->Body.moveTo(begin.body);
    if (this->nextBlock())
    {
      this->Header.postOrder = (this->Kinds & 1) == 0;
    }
  }

private:
  std::string place() const override
  {
    return "element " + std::to_string(this->Element) + " at byte " + std::to_string(this->Offset);
  }

  /** Moves to the next block; returns false at the end. */
  bool nextBlock()
  {
    constexpr std::size_t KindsBytes = sizeof(this->Kinds);
    const std::size_t bytes =
      std::min(this->Body.left(), KindsBytes + BinaryBlockElements * this->ElementBytes);
    if (bytes == 0)
    {
      return false;
    }
    const std::size_t offset = this->Body.offset();
    this->Left = bytes < KindsBytes ? 0 : (bytes - KindsBytes) / this->ElementBytes;
    this->Kinds = bytes < KindsBytes ? 0 : this->Body.take<std::uint32_t>();
    if (bytes != KindsBytes + this->Left * this->ElementBytes ||
        (this->Left < BinaryBlockElements && this->Kinds >> this->Left != 0))
    {
      this->Offset = offset;
      this->Element++;
      this->fail("the block that begins here is not complete: the file is truncated or damaged.");
    }
    return this->Left > 0;
  }

  bool read(StreamEvent& event) override
  {
    if (this->Left == 0 && !this->nextBlock())
    {
      return false;
    }
    this->Element++;
    this->Offset = this->Body.offset();
    (this->Kinds & 1) != 0 ? this->readVertex(event) : this->readCell(event);
    this->Body.skip(this->Offset + this->ElementBytes - this->Body.offset());
    this->Kinds >>= 1;
    this->Left--;
    return true;
  }

  void readVertex(StreamEvent& event)
  {
    event.kind = StreamEvent::Vertex;
    for (float& x : event.position)
    {
      x = this->Body.take<float>();
      if (!std::isfinite(x))
      {
        this->fail("a coordinate is not a finite number.");
      }
    }
    for (int k = 0; k < this->Header.vertexFloats; k++)
    {
      event.floats.push_back(this->Body.take<float>());
    }
    for (int k = 0; k < this->Header.vertexInts; k++)
    {
      event.ints.push_back(this->Body.take<std::int32_t>());
    }
  }

  void readCell(StreamEvent& event)
  {
    event.kind = StreamEvent::Cell;
    const auto most = static_cast<std::int64_t>(this->Input.size() / this->ElementBytes);
    for (int k = 0; k < this->Corners; k++)
    {
      const auto index = this->Body.take<std::int32_t>();
      const auto vertex = this->vertexOf(index, most);
      if (!vertex)
      {
        this->fail("the cell has index " + std::to_string(index) + " after " +
                   std::to_string(this->Vertices) +
                   " vertices, which is not a vertex of this file" +
                   (this->Header.postOrder ? "." : " so far."));
      }
      event.corners[k] = *vertex;
      event.finalMask |= index < 0 ? 1U << k : 0U;
    }
  }

  const std::size_t ElementBytes;
  BinaryInput Body;
  std::uint32_t Kinds = 0;   ///< of the remaining elements of the block
  std::size_t Left = 0;      ///< how many these are
  std::int64_t Element = -1; ///< the last one: its number ...
  std::size_t Offset = 0;    ///< ... and place
};

} // namespace

StreamFileHeader readBinaryHeader(InputFile& file, StreamFormat format)
{
  return readBegin(file, format).header;
}

std::unique_ptr<StreamFileReader> openBinaryStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress)
{
  return std::make_unique<BinaryStreamReader>(path, format, progress);
}

} // namespace smg
