// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFileWriter.h"

#include "IO/Formats/Streams/BinaryStreamWriter.h"
#include "IO/Formats/Streams/TextStreamWriter.h"
#include "smg/Error.h"

#include <algorithm>
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

} // namespace smg
