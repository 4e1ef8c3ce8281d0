// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/TextStreamWriter.h"

#include <charconv>
#include <utility>

namespace smg
{

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
