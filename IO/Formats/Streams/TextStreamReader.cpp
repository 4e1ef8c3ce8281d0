// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace smg
{

namespace
{

/** The lines of a SMA or SVA file. */
class StreamLines
{
public:
  explicit StreamLines(InputFile& file)
    : File(file)
    , Scanner(file)
  {
    // A byte order mark is not skipped: with it a text is taken for OBJ.
    this->Scanner.moveTo(0);
  }

  /** Moves to the begin of the next line; returns false at the end of the file. Throws Error for a
   * line that is too long. */
  bool next()
  {
    if (this->Number > 0)
    {
      this->Scanner.skipLine();
    }
    if (this->Scanner.left() == 0)
    {
      return false;
    }
    ++this->Number;
    if (!this->Scanner.restOfLine())
    {
      throw Error(this->File.name() + ": line " + std::to_string(this->Number) + " has more than " +
                  std::to_string(TextScanner::MaxTokenBytes) +
                  " characters: this is not a file of that kind.");
    }
    return true;
  }
  /** The number of the last line, from 1. */
  std::int64_t number() const { return this->Number; }
  /** The rest of the line, valid until its next word is read. */
  std::string_view text() { return *this->Scanner.restOfLine(); }

  /** The next word of the line, valid until the following one; empty at the end of the line. */
  std::string_view word() { return this->Scanner.tokenInLine(); }
  /** Reads a number; returns false if the next word is not a number of that type. */
  template <class T>
  bool read(T& number)
  {
    const std::string_view word = this->word();
    std::optional<T> value = parseWhole<T>(word);
    if constexpr (std::is_same_v<T, float>)
    {
      // Numbers that underflow in single precision are zero, not an error.
      const std::optional<double> wide = value ? std::nullopt : parseWhole<double>(word);
      value = wide && std::abs(*wide) < 1.0 ? std::optional(static_cast<float>(*wide)) : value;
    }
    number = value.value_or(number);
    return value.has_value();
  }

private:
  InputFile& File;
  TextScanner Scanner;
  std::int64_t Number = 0;
};

/**
 * The maximum number of further values of a vertex or cell; with more its line would be too long.
 */
constexpr std::int64_t MaxValues = 1000;

/** Reads SMA and SVA. */
class TextStreamReader : public StreamFileReader
{
public:
  TextStreamReader(
    const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress)
    : StreamFileReader(path, format, progress)
    , Lines(this->Input)
    , HasTets(cellTypeOf(format) == CellType::Tetrahedron)
    , CellKey(this->HasTets ? "c" : "f")
  {
    this->Bounds.fill(std::numeric_limits<double>::quiet_NaN());
    this->readHeader();
  }

private:
  std::string place() const override { return "line " + std::to_string(this->Lines.number()); }

  void readHeader()
  {
    while (this->Key.empty())
    {
      if (!this->Lines.next())
      {
        this->fail("the file ends before the first vertex or cell: it is empty or truncated.");
      }
      const std::string line(this->Lines.text());
      const std::string_view word = this->Lines.word();
      if (word.starts_with('#'))
      {
        const std::string key(word == "#" ? this->Lines.word() : word.substr(1));
        this->readComment(key, line.substr(line.find('#') + 1));
      }
      else if (!word.empty() && word != "v" && word != "f" && word != "c" && word != "x")
      {
        this->failAt(word);
      }
      else
      {
        this->Key = word;
      }
    }
    this->Header.postOrder = this->Key == this->CellKey;
    if (std::ranges::all_of(this->Bounds, [](double bound) { return std::isfinite(bound); }))
    {
      this->Header.bounds = this->Bounds;
    }
  }

  /** A comment `text` with the first word `key`. */
  void readComment(const std::string& key, std::string_view text)
  {
    StreamFileHeader& header = this->Header;
    if (key == "nverts")
    {
      header.vertices = this->headerNumber(key, -1);
    }
    else if (key == (this->HasTets ? "ncells" : "nfaces"))
    {
      header.cells = this->headerNumber(key, -1);
    }
    else if (key == "bb_min" || (this->HasTets && key == "v_pmin_f"))
    {
      this->readBounds(false);
    }
    else if (key == "bb_max" || (this->HasTets && key == "v_pmax_f"))
    {
      this->readBounds(true);
    }
    else if (this->HasTets && key == "svtype")
    {
      if (const std::string_view type = this->Lines.word(); type != "tet")
      {
        this->fail("cells of type " + inQuotes(type) + " are not known; the only type is tet.");
      }
    }
    else if (this->HasTets && key == "v_pnum_f")
    {
      header.vertexFloats = static_cast<int>(this->headerNumber(key, 3)) - 3;
    }
    else if (this->HasTets && key == "v_pnum_i")
    {
      header.vertexInts = static_cast<int>(this->headerNumber(key, 0));
    }
    else if (this->HasTets && key == "c_pnum_f")
    {
      this->CellFloats = static_cast<int>(this->headerNumber(key, 0));
    }
    else if (this->HasTets && key == "c_pnum_i")
    {
      header.cellInts = static_cast<int>(this->headerNumber(key, 0));
    }
    else
    {
      this->keepComment(text);
    }
  }

  void keepComment(std::string_view text)
  {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    text.remove_suffix(text.ends_with('\r') ? 1 : 0);
    this->Header.comments.emplace_back(text);
    // An empty one takes memory, too.
    this->CommentBytes += static_cast<std::int64_t>(sizeof(std::string) + text.size());
    if (this->CommentBytes > StreamFileHeader::MaxCommentBytes)
    {
      this->fail("the comments before the first vertex or cell have more than 1 MiB, which is more "
                 "than is read: remove some of them.");
    }
  }

  std::int64_t headerNumber(const std::string& key, std::int64_t least)
  {
    const bool isCount = key[0] == 'n';
    std::int64_t value = 0;
    if (!this->Lines.read(value) || value < least || (!isCount && value > MaxValues))
    {
      this->fail(key + " is not followed by a number that makes sense.");
    }
    return value;
  }

  void readBounds(bool upper)
  {
    for (int axis = 0; axis < 3; axis++)
    {
      double& bound = this->Bounds[2 * axis + (upper ? 1 : 0)];
      if (!this->Lines.read(bound) || !std::isfinite(bound))
      {
        this->fail("the bounding box is not given by three finite numbers.");
      }
    }
  }

  [[noreturn]] void failAt(std::string_view word) const
  {
    this->fail("a line of a " + std::string(nameOf(this->Header.format)) +
               " file cannot begin with " + inQuotes(word) + '.');
  }

  /** The first word of the next line that is not a comment; empty at the end. */
  std::string_view nextKey()
  {
    std::string_view key = std::exchange(this->Key, {});
    while (key.empty() && this->Lines.next())
    {
      key = this->Lines.word();
      key = key.starts_with('#') ? std::string_view() : key;
    }
    return key;
  }

  bool read(StreamEvent& event) override
  {
    const std::string_view key = this->nextKey();
    if (key.empty())
    {
      return false;
    }
    bool restIsIgnored = false;
    if (key == "v")
    {
      event.kind = StreamEvent::Vertex;
      this->readVertex(event);
    }
    else if (key == this->CellKey)
    {
      event.kind = StreamEvent::Cell;
      this->readCell(event);
      restIsIgnored = this->CellFloats > 0;
    }
    else if (key == "x")
    {
      event.kind = StreamEvent::Finalization;
      event.corners[0] = this->vertex(this->readIndex());
      if (event.corners[0] >= this->Vertices)
      {
        this->fail("a vertex that is not defined yet cannot be final.");
      }
    }
    else
    {
      this->failAt(key);
    }
    if (!restIsIgnored && !this->Lines.word().empty())
    {
      this->fail("there is more on the line than there should be.");
    }
    return true;
  }

  void readVertex(StreamEvent& event)
  {
    for (float& x : event.position)
    {
      if (!this->Lines.read(x) || !std::isfinite(x))
      {
        this->fail("the coordinates are not three finite numbers of single precision.");
      }
    }
    event.floats.resize(this->Header.vertexFloats);
    event.ints.resize(this->Header.vertexInts);
    const auto read = [this](auto& value) { return this->Lines.read(value); };
    if (!std::ranges::all_of(event.floats, read) || !std::ranges::all_of(event.ints, read))
    {
      this->fail("the vertex has not the " +
                 std::to_string(3 + this->Header.vertexFloats + this->Header.vertexInts) +
                 " numbers that the header says.");
    }
  }

  void readCell(StreamEvent& event)
  {
    for (int k = 0; k < this->Corners; k++)
    {
      const std::int64_t index = this->readIndex();
      event.corners[k] = this->vertex(index);
      event.finalMask |= index < 0 ? 1U << k : 0U;
    }
    event.ints.resize(this->Header.cellInts);
    if (!std::ranges::all_of(
          event.ints, [this](std::int32_t& value) { return this->Lines.read(value); }))
    {
      this->fail("the cell has not the " + std::to_string(this->Header.cellInts) +
                 " integers that the header says.");
    }
  }

  std::int64_t readIndex()
  {
    std::int64_t index = 0;
    if (!this->Lines.read(index) || index == 0)
    {
      this->fail("the indices are not integers other than 0.");
    }
    return index;
  }

  std::int64_t vertex(std::int64_t index) const
  {
    // Every vertex takes some bytes, so an impossible index is detected before the end.
    const auto vertex = this->vertexOf(index, static_cast<std::int64_t>(this->Input.size()));
    if (!vertex)
    {
      const bool postOrder = this->Header.postOrder;
      this->fail("index " + std::to_string(index) +
                 (index < 0 ? postOrder ? " is relative, but the vertices come after their cells."
                                        : " goes back behind the first vertex."
                   : postOrder ? " is larger than the number of vertices."
                               : " is of a vertex that is not defined yet."));
    }
    return *vertex;
  }

  StreamLines Lines;
  const bool HasTets;
  const std::string_view CellKey;
  std::array<double, 6> Bounds; ///< not numbers where they are not given
  int CellFloats = 0;
  std::int64_t CommentBytes = 0; ///< see StreamFileHeader
  std::string_view Key; ///< the first word of a line of the body that has been read; empty: none
};

/** The maximum number of lines read to distinguish the text formats. */
constexpr int LinesLookedAt = 10000;

/** What the first words of a line say about the text format; a comment may hold data of the mesh,
 * its other words are arbitrary. */
std::optional<StreamFormat> formatOfLine(std::string_view first, std::string_view second)
{
  const std::string_view key = first == "#" ? second : std::string_view();
  if (first == "f" || key == "nfaces")
  {
    return StreamFormat::Sma;
  }
  if (first == "c" || key == "ncells" || key == "svtype" || key == "v_pnum_f")
  {
    return StreamFormat::Sva;
  }
  return {};
}

} // namespace

std::optional<StreamFormat> formatOfText(InputFile& file)
{
  StreamLines lines(file);
  std::optional<StreamFormat> format;
  for (int i = 0; i < LinesLookedAt && !format && lines.next(); i++)
  {
    const std::string first(lines.word());
    format = formatOfLine(first, lines.word());
  }
  return format;
}

Resemblance resemblanceOfText(InputFile& file)
{
  constexpr int maxValues = 4; // of a vertex; OBJ has six with a colour
  Resemblance result = Resemblance::None;
  StreamLines lines(file);
  for (int i = 0; i < LinesLookedAt && lines.next(); i++)
  {
    const std::string first(lines.word());
    std::string_view word = lines.word();
    const auto format = formatOfLine(first, word);
    if (first == "x" || (format && first != "f"))
    {
      return Resemblance::Sure;
    }
    int words = 0;
    bool hasSlash = false;
    for (; !word.empty(); word = lines.word())
    {
      words++;
      hasSlash = hasSlash || word.find('/') != std::string_view::npos;
    }
    if ((first == "v" && words <= maxValues) || (first == "f" && words == 3 && !hasSlash))
    {
      result = Resemblance::Possible;
    }
    else if (!first.empty() && !first.starts_with('#'))
    {
      return Resemblance::None;
    }
  }
  return result;
}

std::unique_ptr<StreamFileReader> openTextStream(
  const std::filesystem::path& path, StreamFormat format, const ProgressFunction& progress)
{
  return std::make_unique<TextStreamReader>(path, format, progress);
}

} // namespace smg
