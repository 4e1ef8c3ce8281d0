// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFileWriter.h"

#include "IO/Files/ByteOrder.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <string_view>
#include <utility>

namespace smg
{

namespace
{

constexpr std::int64_t MaxCount = INT32_MAX;

} // namespace

StreamFileWriter::StreamFileWriter(std::filesystem::path path, const StreamFileHeader& header)
  : Output(std::move(path))
  , Header(header)
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

std::vector<float> StreamFileWriter::bounds(bool upper) const
{
  const StreamFileHeader& header = this->Header;
  std::vector<float> bounds;
  if (header.bounds && std::ssize(header.floatRanges) == header.vertexFloats)
  {
    for (std::size_t axis = 0; axis < 3; axis++)
    {
      bounds.push_back(static_cast<float>((*header.bounds)[2 * axis + (upper ? 1 : 0)]));
    }
    for (const std::array<float, 2>& range : header.floatRanges)
    {
      bounds.push_back(range[upper ? 1 : 0]);
    }
  }
  return bounds;
}

void StreamFileWriter::checkElement(const char* what, std::int64_t count, bool hasAllNumbers) const
{
  if (!hasAllNumbers || count == MaxCount)
  {
    this->fail(std::string(what) + ' ' + std::to_string(count) +
               " does not have the values of the header, or exceeds its count.");
  }
}

void StreamFileWriter::vertex(std::span<const float, 3> position, std::span<const float> floats,
  std::span<const std::int32_t> ints)
{
  const StreamFileHeader& header = this->Header;
  this->checkElement("vertex", this->Vertices,
    std::ssize(floats) == header.vertexFloats && std::ssize(ints) == header.vertexInts);
  this->Vertices++;
  this->Floats.assign(position.begin(), position.end());
  this->Floats.insert(this->Floats.end(), floats.begin(), floats.end());
  this->put(StreamEvent::Vertex, this->Floats, ints);
}

void StreamFileWriter::cell(
  std::span<const std::int64_t> corners, unsigned finalMask, std::span<const std::int32_t> ints)
{
  const StreamFileHeader& header = this->Header;
  this->checkElement("cell", this->Cells,
    std::ssize(corners) == cornersOf(cellTypeOf(header.format)) &&
      std::ssize(ints) == header.cellInts);
  const std::int64_t most = header.postOrder ? MaxCount : this->Vertices;
  this->Ints.clear();
  for (const std::int64_t corner : corners)
  {
    if (corner < 0 || corner >= most)
    {
      this->fail("cell " + std::to_string(this->Cells) + " uses vertex " + std::to_string(corner) +
                 ", which is not defined yet.");
    }
    const bool final = !header.postOrder && (finalMask >> this->Ints.size() & 1U) != 0;
    this->Ints.push_back(static_cast<std::int32_t>(final ? corner - this->Vertices : corner + 1));
  }
  this->Ints.insert(this->Ints.end(), ints.begin(), ints.end());
  this->Cells++;
  this->put(StreamEvent::Cell, {}, this->Ints);
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

namespace
{

/** Writes SMB and SVB. */
class BinaryStreamWriter : public StreamFileWriter
{
public:
  BinaryStreamWriter(std::filesystem::path path, const StreamFileHeader& header)
    : StreamFileWriter(std::move(path), header)
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

private:
  template <class T>
  static std::uint32_t wordOf(T value)
  {
    return numberAt<std::uint32_t>(&value, std::endian::little);
  }
  template <class T>
  void write(T value)
  {
    const std::uint32_t word = wordOf(value);
    this->Output.put(std::as_bytes(std::span(&word, 1)));
  }
  void writeFlag(bool flag) { this->Output.put(std::string_view(flag ? "\1" : "\0", 1)); }

  void writeHeader()
  {
    const StreamFileHeader& header = this->Header;
    const bool tets = cellTypeOf(header.format) == CellType::Tetrahedron;
    // With the mark of little-endian data.
    const std::byte first[] = { std::byte{ tets ? SvbVersion : SmbVersion }, {}, {}, {} };
    this->Output.put(first);
    this->write(static_cast<std::int32_t>(header.comments.size()));
    for (const std::string& comment : header.comments)
    {
      this->write(static_cast<std::int32_t>(comment.size()));
      this->Output.put(comment);
    }
    this->write(static_cast<std::int32_t>(header.vertices));
    this->write(static_cast<std::int32_t>(header.cells));
    if (tets)
    {
      this->write(3 + header.vertexFloats);
      this->write(header.vertexInts);
    }
    this->writeFlag(!this->bounds(false).empty());
    for (const bool upper : { false, true })
    {
      for (const float bound : this->bounds(upper))
      {
        this->write(bound);
      }
    }
    if (header.vertexInts > 0)
    {
      this->writeFlag(false);
    }
  }

  void put(StreamEvent::Kind kind, std::span<const float> floats,
    std::span<const std::int32_t> ints) override
  {
    const auto words = std::span(this->Block).subspan(this->Elements * this->ElementWords);
    std::ranges::transform(floats, words.begin(), wordOf<float>);
    std::ranges::transform(ints, words.subspan(floats.size()).begin(), wordOf<std::int32_t>);
    std::ranges::fill(words.first(this->ElementWords).subspan(floats.size() + ints.size()), 0);
    this->Kinds |= std::uint32_t(kind == StreamEvent::Vertex) << this->Elements;
    if (++this->Elements == BinaryBlockElements)
    {
      this->flushBlock();
    }
  }

  void flushBlock()
  {
    this->write(this->Kinds);
    this->Output.put(
      std::as_bytes(std::span(this->Block).first(this->Elements * this->ElementWords)));
    this->Kinds = 0;
    this->Elements = 0;
  }

  void complete() override
  {
    // The last block is written even if it is empty, like the original programs of the format.
    this->flushBlock();
  }

  const std::size_t ElementWords;
  std::uint32_t Kinds = 0;  ///< of the elements of the block
  std::size_t Elements = 0; ///< of the block
  std::array<std::uint32_t, 4 * BinaryBlockElements> Block{};
};

/** Writes SMA and SVA. */
class TextStreamWriter : public StreamFileWriter
{
public:
  TextStreamWriter(std::filesystem::path path, const StreamFileHeader& header)
    : StreamFileWriter(std::move(path), header)
  {
    this->writeHeader();
  }

private:
  void writeHeader()
  {
    const StreamFileHeader& header = this->Header;
    const bool tets = cellTypeOf(header.format) == CellType::Tetrahedron;
    for (const std::string& comment : header.comments)
    {
      this->writeLine("# " + comment);
    }
    if (tets)
    {
      this->writeLine("# svtype tet");
    }
    this->writeCount("# nverts", header.vertices, header.vertices >= 0);
    this->writeCount(tets ? "# ncells" : "# nfaces", header.cells, header.cells >= 0);
    this->writeCount("# v_pnum_f", 3 + header.vertexFloats, tets);
    this->writeCount("# v_pnum_i", header.vertexInts, tets && header.vertexInts > 0);
    this->writeCount("# c_pnum_i", header.cellInts, tets && header.cellInts > 0);
    if (const std::vector<float> least = this->bounds(false); !least.empty())
    {
      this->writeLine(tets ? "# v_pmin_f" : "# bb_min", least);
      this->writeLine(tets ? "# v_pmax_f" : "# bb_max", this->bounds(true));
    }
  }

  void writeCount(const char* key, std::int64_t value, bool isGiven)
  {
    if (isGiven)
    {
      const auto number = static_cast<std::int32_t>(value);
      this->writeLine(key, {}, { &number, 1 });
    }
  }

  void put(StreamEvent::Kind kind, std::span<const float> floats,
    std::span<const std::int32_t> ints) override
  {
    const bool tets = cellTypeOf(this->Header.format) == CellType::Tetrahedron;
    this->writeLine(kind == StreamEvent::Vertex ? "v" : tets ? "c" : "f", floats, ints);
  }

  void finalization(std::int64_t vertex) override
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
    const auto index = static_cast<std::int32_t>(vertex - this->Vertices);
    this->writeLine("x", {}, { &index, 1 });
  }

  /** Writes a line that begins with `text`. */
  void writeLine(std::string_view text, std::span<const float> floats = {},
    std::span<const std::int32_t> ints = {})
  {
    this->Line = text;
    const auto add = [this](auto... number)
    {
      char digits[32];
      const auto end = std::to_chars(digits, digits + sizeof(digits), number...);
      this->Line += ' ';
      this->Line.append(digits, end.ptr);
    };
    for (const float value : floats)
    {
      // Nine digits are sufficient to restore every single precision number.
      add(value, std::chars_format::general, 9);
    }
    for (const std::int32_t value : ints)
    {
      add(value);
    }
    this->Line += '\n';
    this->Output.put(this->Line);
  }

  std::string Line;
};

} // namespace

std::unique_ptr<StreamFileWriter> createStreamFile(
  std::filesystem::path path, const StreamFileHeader& header)
{
  if (isText(header.format))
  {
    return std::make_unique<TextStreamWriter>(std::move(path), header);
  }
  return std::make_unique<BinaryStreamWriter>(std::move(path), header);
}

} // namespace smg
