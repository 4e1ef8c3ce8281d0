// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFileWriter.h"

#include "IO/Files/ByteOrder.h"
#include "smg/Error.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <utility>

namespace smg
{

namespace
{

constexpr std::int64_t MaxCount = INT32_MAX;

} // namespace

StreamFileWriter::StreamFileWriter(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style)
  : Output(std::move(path))
  , Header(header)
  , Style(style)
{
  if (header.vertices > MaxCount || header.cells > MaxCount)
  {
    this->fail("the format " + std::string(nameOf(header.format)) + " has room for " +
               std::to_string(MaxCount) + " vertices and as many cells, but there are " +
               std::to_string(header.vertices) + " and " + std::to_string(header.cells) +
               "; write a .vsm file.");
  }
}

void StreamFileWriter::fail(const std::string& what) const
{
  throw Error(this->Output.path().string() + ": " + what);
}

bool StreamFileWriter::hasBounds() const
{
  return this->Header.bounds &&
         static_cast<int>(this->Header.floatRanges.size()) == this->Header.vertexFloats;
}

float StreamFileWriter::bound(int k, bool upper) const
{
  return k < 3 ? static_cast<float>((*this->Header.bounds)[2 * k + (upper ? 1 : 0)])
               : this->Header.floatRanges[k - 3][upper ? 1 : 0];
}

void StreamFileWriter::countVertex(std::size_t floats, std::size_t ints)
{
  if (floats != std::size_t(this->Header.vertexFloats) ||
      ints != std::size_t(this->Header.vertexInts) || this->Vertices == MaxCount)
  {
    this->fail("vertex " + std::to_string(this->Vertices) +
               " does not have the values of the header, or exceeds its count.");
  }
  this->Vertices++;
}

void StreamFileWriter::countCell(
  std::span<const std::int64_t> corners, unsigned finalMask, std::size_t ints)
{
  const bool relative =
    !this->Header.postOrder && this->Style.finalization == StreamFileStyle::InCell;
  const std::int64_t most = this->Header.postOrder ? MaxCount : this->Vertices;
  if (corners.size() != std::size_t(cornersOf(cellTypeOf(this->Header.format))) ||
      ints != std::size_t(this->Header.cellInts) || this->Cells == MaxCount)
  {
    this->fail("cell " + std::to_string(this->Cells) +
               " does not have the values of the header, or exceeds its count.");
  }
  for (std::size_t k = 0; k < corners.size(); k++)
  {
    if (corners[k] < 0 || corners[k] >= most)
    {
      this->fail("cell " + std::to_string(this->Cells) + " uses vertex " +
                 std::to_string(corners[k]) + ", which is not defined yet.");
    }
    const bool final = relative && (finalMask >> k & 1U) != 0;
    this->Indices[k] =
      static_cast<std::int32_t>(final ? corners[k] - this->Vertices : corners[k] + 1);
  }
  this->Cells++;
}

void StreamFileWriter::finish()
{
  if ((this->Header.vertices >= 0 && this->Header.vertices != this->Vertices) ||
      (this->Header.cells >= 0 && this->Header.cells != this->Cells))
  {
    this->fail(std::to_string(this->Vertices) + " vertices and " + std::to_string(this->Cells) +
               " cells were written, but the header says " + std::to_string(this->Header.vertices) +
               " and " + std::to_string(this->Header.cells) + ".");
  }
  this->complete();
  this->Output.finish();
}

std::unique_ptr<StreamFileWriter> createStreamFile(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style)
{
  if (isText(header.format))
  {
    return std::make_unique<TextStreamWriter>(std::move(path), header, style);
  }
  return std::make_unique<BinaryStreamWriter>(std::move(path), header, style);
}

BinaryStreamWriter::BinaryStreamWriter(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style)
  : StreamFileWriter(std::move(path), header, style)
  , Swapped(style.bigEndian != (std::endian::native == std::endian::big))
  , ElementWords(cornersOf(cellTypeOf(header.format)))
{
  const std::size_t values = 3 + header.vertexFloats + header.vertexInts;
  if (values > this->ElementWords || header.cellInts > 0)
  {
    this->fail("the format " + std::string(nameOf(header.format)) +
               " has no room for so many values of a vertex or a cell.");
  }
  this->writeHeader();
}

template <class T>
void BinaryStreamWriter::write(T value)
{
  static_assert(sizeof(T) == 4);
  const T stored = this->Swapped ? byteSwapped(value) : value;
  this->Output.put(std::as_bytes(std::span(&stored, 1)));
}

void BinaryStreamWriter::writeFlag(bool flag)
{
  const std::byte byte{ flag };
  this->Output.put(std::span(&byte, 1));
}

void BinaryStreamWriter::writeHeader()
{
  const StreamFileHeader& header = this->Header;
  const int flag = this->Style.endianFlag >= 0 ? this->Style.endianFlag : this->Style.bigEndian;
  const bool tets = cellTypeOf(header.format) == CellType::Tetrahedron;
  const std::byte first[] = { std::byte{ tets ? SvbVersion : SmbVersion },
    static_cast<std::byte>(flag), {}, {} };
  this->Output.put(first);
  this->write(static_cast<std::int32_t>(header.comments.size()));
  for (const std::string& comment : header.comments)
  {
    this->write(static_cast<std::int32_t>(comment.size()));
    this->Output.put(comment);
  }
  this->write(static_cast<std::int32_t>(header.vertices));
  this->write(static_cast<std::int32_t>(header.cells));
  const int floats = 3 + header.vertexFloats;
  if (tets)
  {
    this->write(floats);
    this->write(header.vertexInts);
  }
  this->writeFlag(this->hasBounds());
  if (this->hasBounds())
  {
    for (int k = 0; k < 2 * floats; k++)
    {
      this->write(this->bound(k % floats, k >= floats));
    }
  }
  if (header.vertexInts > 0)
  {
    this->writeFlag(false);
  }
}

template <class T>
void BinaryStreamWriter::addWord(T value)
{
  static_assert(sizeof(T) == 4);
  this->Block[this->Words++] =
    std::bit_cast<std::uint32_t>(this->Swapped ? byteSwapped(value) : value);
}

void BinaryStreamWriter::endElement(bool isVertex)
{
  this->Kinds |= std::uint32_t(isVertex) << this->Elements;
  this->Elements++;
  while (this->Words < this->Elements * this->ElementWords)
  {
    this->Block[this->Words++] = 0;
  }
  if (this->Elements == BinaryBlockElements)
  {
    this->flushBlock();
  }
}

void BinaryStreamWriter::flushBlock()
{
  this->write(this->Kinds);
  this->Output.put(std::as_bytes(std::span(this->Block).first(this->Words)));
  this->Kinds = 0;
  this->Elements = 0;
  this->Words = 0;
}

void BinaryStreamWriter::complete()
{
  // The last block is written even if it is empty, like the original programs of the format.
  this->flushBlock();
}

void BinaryStreamWriter::vertex(std::span<const float, 3> position, std::span<const float> floats,
  std::span<const std::int32_t> ints)
{
  this->countVertex(floats.size(), ints.size());
  for (const float x : position)
  {
    this->addWord(x);
  }
  for (const float value : floats)
  {
    this->addWord(value);
  }
  for (const std::int32_t value : ints)
  {
    this->addWord(value);
  }
  this->endElement(true);
}

void BinaryStreamWriter::cell(
  std::span<const std::int64_t> corners, unsigned finalMask, std::span<const std::int32_t> ints)
{
  this->countCell(corners, finalMask, ints.size());
  for (std::size_t k = 0; k < corners.size(); k++)
  {
    this->addWord(this->Indices[k]);
  }
  this->endElement(false);
}

TextStreamWriter::TextStreamWriter(
  std::filesystem::path path, const StreamFileHeader& header, const StreamFileStyle& style)
  : StreamFileWriter(std::move(path), header, style)
{
  this->writeHeader();
}

void TextStreamWriter::writeHeader()
{
  const StreamFileHeader& header = this->Header;
  const bool tets = cellTypeOf(header.format) == CellType::Tetrahedron;
  const auto count = [this](const char* key, std::int64_t value)
  {
    this->Line = key;
    this->add(value);
    this->endLine();
  };
  for (const std::string& comment : header.comments)
  {
    this->Line = "# " + comment;
    this->endLine();
  }
  if (tets)
  {
    this->Line = "# svtype tet";
    this->endLine();
  }
  if (header.vertices >= 0)
  {
    count("# nverts", header.vertices);
  }
  if (header.cells >= 0)
  {
    count(tets ? "# ncells" : "# nfaces", header.cells);
  }
  if (tets)
  {
    count("# v_pnum_f", 3 + header.vertexFloats);
    if (header.vertexInts > 0)
    {
      count("# v_pnum_i", header.vertexInts);
    }
    if (header.cellInts > 0)
    {
      count("# c_pnum_i", header.cellInts);
    }
  }
  if (this->hasBounds())
  {
    this->writeBounds(tets ? "# v_pmin_f" : "# bb_min", false);
    this->writeBounds(tets ? "# v_pmax_f" : "# bb_max", true);
  }
}

void TextStreamWriter::writeBounds(const char* key, bool upper)
{
  this->Line = key;
  for (int k = 0; k < 3 + this->Header.vertexFloats; k++)
  {
    this->add(this->bound(k, upper));
  }
  this->endLine();
}

void TextStreamWriter::add(float value)
{
  char text[32];
  // Nine digits are sufficient to restore every single precision number.
  const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 9);
  this->Line += ' ';
  this->Line.append(text, end.ptr);
}

void TextStreamWriter::add(std::int64_t value)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value);
  this->Line += ' ';
  this->Line.append(text, end.ptr);
}

void TextStreamWriter::endLine()
{
  this->Line += '\n';
  this->Output.put(this->Line);
}

void TextStreamWriter::vertex(std::span<const float, 3> position, std::span<const float> floats,
  std::span<const std::int32_t> ints)
{
  this->countVertex(floats.size(), ints.size());
  this->Line.assign(1, 'v');
  for (const float x : position)
  {
    this->add(x);
  }
  for (const float value : floats)
  {
    this->add(value);
  }
  for (const std::int32_t value : ints)
  {
    this->add(std::int64_t(value));
  }
  this->endLine();
}

void TextStreamWriter::cell(
  std::span<const std::int64_t> corners, unsigned finalMask, std::span<const std::int32_t> ints)
{
  this->countCell(corners, finalMask, ints.size());
  this->Line.assign(1, corners.size() == 3 ? 'f' : 'c');
  for (std::size_t k = 0; k < corners.size(); k++)
  {
    this->add(std::int64_t(this->Indices[k]));
  }
  for (const std::int32_t value : ints)
  {
    this->add(std::int64_t(value));
  }
  this->endLine();
  if (this->Style.finalization == StreamFileStyle::Explicit)
  {
    for (std::size_t k = 0; k < corners.size(); k++)
    {
      if ((finalMask >> k & 1U) != 0)
      {
        this->finalization(corners[k]);
      }
    }
  }
}

void TextStreamWriter::finalization(std::int64_t vertex)
{
  if (this->Header.postOrder)
  {
    return;
  }
  if (vertex < 0 || vertex >= this->Vertices)
  {
    this->fail(
      "vertex " + std::to_string(vertex) + " cannot be final, since it is not defined yet.");
  }
  this->Line.assign(1, 'x');
  this->add(vertex - this->Vertices);
  this->endLine();
}

} // namespace smg
