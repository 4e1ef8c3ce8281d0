// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/BinaryStreamWriter.h"

#include <bit>
#include <utility>

namespace smg
{

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

} // namespace smg
