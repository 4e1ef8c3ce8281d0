// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/TextStreamReader.h"

#include "IO/Files/FileNames.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

/**
 * The maximum number of further values of a vertex or cell; with more its line would be too long.
 */
constexpr std::int64_t MaxValues = 1000;

bool isBodyKey(std::string_view key)
{
  return key == "v" || key == "f" || key == "c" || key == "x";
}

} // namespace

TextStreamReader::TextStreamReader(const std::filesystem::path& path, StreamFormat format)
  : StreamFileReader(path)
  , CellKey(cellTypeOf(format) == CellType::Triangle ? 'f' : 'c')
{
  this->Header.format = format;
  this->readHeader();
}

std::string TextStreamReader::place() const
{
  return "line " + std::to_string(this->Input.lineNumber());
}

void TextStreamReader::readHeader()
{
  while (!this->Pending)
  {
    if (!this->Input.nextLine(this->Line))
    {
      this->fail("the file ends before the first vertex or cell: it is empty or truncated.");
    }
    Tokens tokens(this->Line);
    const std::string_view key = tokens.word();
    if (!key.empty() && key[0] == '#')
    {
      Tokens comment(this->Line.substr(this->Line.find('#') + 1));
      this->readComment(comment);
    }
    else if (isBodyKey(key))
    {
      this->Pending = true;
      this->Header.postOrder = key[0] == this->CellKey;
    }
    else if (!key.empty())
    {
      this->fail("a line of a " + std::string(nameOf(this->Header.format)) +
                 " file cannot begin with " + inQuotes(key) + '.');
    }
  }
  if (this->HasLower && this->HasUpper)
  {
    this->Header.bounds = this->Bounds;
  }
}

void TextStreamReader::readComment(Tokens& tokens)
{
  const std::string_view whole = tokens.rest();
  const std::string_view key = tokens.word();
  const bool tets = cellTypeOf(this->Header.format) == CellType::Tetrahedron;
  if (key == "nverts")
  {
    this->Header.vertices = this->headerNumber(tokens, key, -1);
  }
  else if (key == (tets ? "ncells" : "nfaces"))
  {
    this->Header.cells = this->headerNumber(tokens, key, -1);
  }
  else if (key == "bb_min" || (tets && key == "v_pmin_f"))
  {
    this->headerBounds(tokens, false);
  }
  else if (key == "bb_max" || (tets && key == "v_pmax_f"))
  {
    this->headerBounds(tokens, true);
  }
  else if (tets && key == "svtype")
  {
    if (const std::string_view type = tokens.word(); type != "tet")
    {
      this->fail("cells of type " + inQuotes(type) + " are not known; the only type is tet.");
    }
  }
  else if (tets && key == "v_pnum_f")
  {
    this->Header.vertexFloats = static_cast<int>(this->headerNumber(tokens, key, 3)) - 3;
  }
  else if (tets && key == "v_pnum_i")
  {
    this->Header.vertexInts = static_cast<int>(this->headerNumber(tokens, key, 0));
  }
  else if (tets && key == "c_pnum_f")
  {
    this->CellFloats = static_cast<int>(this->headerNumber(tokens, key, 0));
  }
  else if (tets && key == "c_pnum_i")
  {
    this->Header.cellInts = static_cast<int>(this->headerNumber(tokens, key, 0));
  }
  else
  {
    const std::size_t begin = std::min(whole.find_first_not_of(" \t"), whole.size());
    this->Header.comments.emplace_back(whole.substr(begin));
    // An empty one takes memory, too.
    this->CommentBytes +=
      static_cast<std::int64_t>(sizeof(std::string) + this->Header.comments.back().size());
    if (this->CommentBytes > StreamFileHeader::MaxCommentBytes)
    {
      this->fail("the comments before the first vertex or cell have more than 1 MiB, which is more "
                 "than is read: remove some of them.");
    }
  }
}

std::int64_t TextStreamReader::headerNumber(
  Tokens& tokens, std::string_view key, std::int64_t least)
{
  const bool isCount = key[0] == 'n';
  std::int64_t value = 0;
  if (!tokens.number(value) || value < least || (!isCount && value > MaxValues))
  {
    this->fail(std::string(key) + " is not followed by a number that makes sense.");
  }
  return value;
}

void TextStreamReader::headerBounds(Tokens& tokens, bool upper)
{
  for (int axis = 0; axis < 3; axis++)
  {
    double& bound = this->Bounds[2 * axis + (upper ? 1 : 0)];
    if (!tokens.number(bound) || !std::isfinite(bound))
    {
      this->fail("the bounding box is not given by three finite numbers.");
    }
  }
  (upper ? this->HasUpper : this->HasLower) = true;
}

bool TextStreamReader::nextBodyLine()
{
  while (!this->Pending)
  {
    if (!this->Input.nextLine(this->Line))
    {
      return false;
    }
    const std::size_t begin = this->Line.find_first_not_of(" \t");
    this->Pending = begin != std::string_view::npos && this->Line[begin] != '#';
  }
  this->Pending = false;
  return true;
}

bool TextStreamReader::read(StreamEvent& event)
{
  if (!this->nextBodyLine())
  {
    return false;
  }
  Tokens tokens(this->Line);
  const std::string_view key = tokens.word();
  bool restIsIgnored = false;
  if (key == "v")
  {
    event.kind = StreamEvent::Vertex;
    this->readVertex(tokens, event);
  }
  else if (key.size() == 1 && key[0] == this->CellKey)
  {
    event.kind = StreamEvent::Cell;
    this->readCell(tokens, event);
    restIsIgnored = this->CellFloats > 0;
  }
  else if (key == "x")
  {
    event.kind = StreamEvent::Finalization;
    bool final = false;
    event.corners[0] = this->readIndex(tokens, final);
    if (event.corners[0] >= this->Vertices)
    {
      this->fail("a vertex that is not defined yet cannot be final.");
    }
  }
  else
  {
    this->fail("a line of a " + std::string(nameOf(this->Header.format)) +
               " file cannot begin with " + inQuotes(key) + '.');
  }
  if (!restIsIgnored && !tokens.word().empty())
  {
    this->fail("there is more on the line than there should be.");
  }
  return true;
}

void TextStreamReader::readVertex(Tokens& tokens, StreamEvent& event)
{
  for (float& x : event.position)
  {
    if (!tokens.number(x) || !std::isfinite(x))
    {
      this->fail("the coordinates are not three finite numbers of single precision.");
    }
  }
  event.floats.resize(this->Header.vertexFloats);
  event.ints.resize(this->Header.vertexInts);
  const auto read = [&tokens](auto& value) { return tokens.number(value); };
  if (!std::all_of(event.floats.begin(), event.floats.end(), read) ||
      !std::all_of(event.ints.begin(), event.ints.end(), read))
  {
    this->fail("the vertex has not the " +
               std::to_string(3 + this->Header.vertexFloats + this->Header.vertexInts) +
               " numbers that the header says.");
  }
}

void TextStreamReader::readCell(Tokens& tokens, StreamEvent& event)
{
  for (int k = 0; k < cornersOf(cellTypeOf(this->Header.format)); k++)
  {
    bool final = false;
    event.corners[k] = this->readIndex(tokens, final);
    event.finalMask |= final ? 1U << k : 0U;
  }
  event.ints.resize(this->Header.cellInts);
  if (!std::all_of(event.ints.begin(), event.ints.end(),
        [&tokens](std::int32_t& value) { return tokens.number(value); }))
  {
    this->fail("the cell has not the " + std::to_string(this->Header.cellInts) +
               " integers that the header says.");
  }
}

std::int64_t TextStreamReader::readIndex(Tokens& tokens, bool& final)
{
  std::int64_t index = 0;
  if (!tokens.number(index) || index == 0)
  {
    this->fail("the indices are not integers other than 0.");
  }
  final = index < 0;
  if (final && (this->Header.postOrder || index < -this->Vertices))
  {
    this->fail("index " + std::to_string(index) +
               (this->Header.postOrder ? " is relative, but the vertices come after their cells."
                                       : " goes back behind the first vertex."));
  }
  const std::int64_t vertex = final ? this->Vertices + index : index - 1;
  // Every vertex takes some bytes, so an impossible index is detected before the end.
  const std::int64_t most =
    this->Header.postOrder
      ? (this->Header.vertices >= 0 ? std::min(this->Header.vertices, this->Input.size())
                                    : this->Input.size())
      : this->Vertices;
  if (vertex >= most)
  {
    this->fail("index " + std::to_string(index) +
               (this->Header.postOrder ? " is larger than the number of vertices."
                                       : " is of a vertex that is not defined yet."));
  }
  return vertex;
}

} // namespace smg
