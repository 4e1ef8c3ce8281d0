// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFile.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/SequentialInput.h"
#include "IO/Formats/Foreign/ForeignFile.h"
#include "IO/Formats/Streams/BinaryStreamReader.h"
#include "IO/Formats/Streams/TextStreamReader.h"
#include "IO/Mesh/Format.h"
#include "smg/Error.h"

#include <algorithm>
#include <cctype>

namespace smg
{

namespace
{

/** The maximum number of lines read to distinguish the text formats. */
constexpr int LinesLookedAt = 10000;

/** What a line says about the text format; a comment may hold data of the mesh, its other words are
 * arbitrary. */
std::optional<StreamFormat> formatOfLine(std::string_view line)
{
  Tokens tokens(line);
  const std::string_view first = tokens.word();
  const std::string_view key = first == "#" ? tokens.word() : std::string_view();
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

/** The text format, by the first line that only one of them can have. */
std::optional<StreamFormat> detectText(SequentialInput& input)
{
  std::string_view line;
  for (int i = 0; i < LinesLookedAt && input.nextLine(line); i++)
  {
    if (const auto format = formatOfLine(line))
    {
      return format;
    }
  }
  return {};
}

/** The number of words after the first one, if none of them has a slash; otherwise -1. */
int plainWords(std::string_view line)
{
  Tokens tokens(line);
  tokens.word();
  int count = 0;
  for (std::string_view word = tokens.word(); !word.empty(); word = tokens.word())
  {
    if (word.find('/') != std::string_view::npos)
    {
      return -1;
    }
    count++;
  }
  return count;
}

/** Vertices and triangles alone are OBJ as well; other lines are of one format only. */
Resemblance textResemblance(SequentialInput& input)
{
  constexpr int maxValues = 4; // of a vertex; OBJ has six with a colour
  Resemblance result = Resemblance::None;
  std::string_view line;
  for (int i = 0; i < LinesLookedAt && input.nextLine(line); i++)
  {
    const std::string_view first = Tokens(line).word();
    const auto format = formatOfLine(line);
    if (first == "x" || (format && first != "f"))
    {
      return Resemblance::Sure;
    }
    const int words = plainWords(line);
    const bool isVertex = first == "v" && words <= maxValues;
    if (isVertex || (first == "f" && words == 3))
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

} // namespace

std::optional<StreamFormat> streamFormatOfName(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  for (const StreamFormat format :
    { StreamFormat::Sma, StreamFormat::Smb, StreamFormat::Sva, StreamFormat::Svb })
  {
    std::string name(nameOf(format));
    std::transform(name.begin(), name.end(), name.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (suffix.size() == name.size() + 1 && suffix.ends_with(name))
    {
      return format;
    }
  }
  return {};
}

bool isStreamSuffix(std::string_view suffix)
{
  constexpr std::string_view suffixes[] = { ".sma", ".smb", ".smc", ".smd", ".sva", ".svb",
    ".svc" };
  return std::ranges::find(suffixes, suffix) != std::end(suffixes);
}

StreamFormat detectStreamFormat(const std::filesystem::path& path)
{
  SequentialInput input(path);
  const std::span<const std::byte> bytes = input.peek(2);
  if (bytes.empty())
  {
    throw Error(path.string() + ": the file is empty.");
  }
  const auto refuse = [&path](const std::string& what)
  { throw Error(path.string() + ": " + what); };
  const std::string suffix = lowerSuffix(path);
  const auto first = std::to_integer<unsigned>(bytes[0]);
  const bool isCompressed = first == 1 || first == 2 || first == 3;
  if (first == 0x1f && bytes.size() > 1 && bytes[1] == std::byte{ 0x8b })
  {
    refuse("is compressed with gzip, which is not read: unpack it first.");
  }
  const auto refuseCompressed = [&]
  {
    const std::string name = suffix == ".svc" ? "SVC" : first == 2 ? "SMD" : "SMC";
    refuse("is in the compressed format " + name +
           ", which is not read: convert it to SMB or SVB with the program that made it.");
  };
  if (isCompressed)
  {
    refuseCompressed();
  }
  if (first == SmbVersion || first == SvbVersion)
  {
    return first == SmbVersion ? StreamFormat::Smb : StreamFormat::Svb;
  }
  const auto byName = streamFormatOfName(path);
  {
    const std::span<const std::byte> start = input.peek(FormatBytes);
    refuseForeign(path.string(),
      std::string_view(reinterpret_cast<const char*>(start.data()), start.size()),
      byName ? "an " + std::string(nameOf(*byName)) + " file" : std::string("a mesh stream"));
  }
  const auto byText = detectText(input);
  if (!byText && (suffix == ".smc" || suffix == ".smd" || suffix == ".svc"))
  {
    refuseCompressed();
  }
  if (!byText && !(byName && isText(*byName)))
  {
    refuse("is none of the formats SMA, SMB, SVA and SVB, or is damaged in its first bytes.");
  }
  return byText ? *byText : *byName;
}

Resemblance resemblanceToStream(const std::filesystem::path& path)
{
  try
  {
    SequentialInput input(path);
    const std::span<const std::byte> bytes = input.peek(1);
    if (bytes.empty())
    {
      return Resemblance::None;
    }
    const auto first = std::to_integer<unsigned>(bytes[0]);
    if (first != SmbVersion && first != SvbVersion)
    {
      return textResemblance(input);
    }
    // Many binary files begin with a zero: the rest of the header has to make sense, too.
    const StreamFileHeader header = readBinaryStreamHeader(FileDescriptor::openForReading(path),
      first == SmbVersion ? StreamFormat::Smb : StreamFormat::Svb)
                                      .header;
    return header.vertices != 0 && header.cells != 0 ? Resemblance::Sure : Resemblance::None;
  }
  catch (const Error&)
  {
    return Resemblance::None;
  }
}

void StreamFileReader::next(StreamEvent& event)
{
  event.floats.clear();
  event.ints.clear();
  event.finalMask = 0;
  if (!this->read(event))
  {
    this->checkEnd();
    event.kind = StreamEvent::End;
  }
  this->Vertices += event.kind == StreamEvent::Vertex ? 1 : 0;
  this->Cells += event.kind == StreamEvent::Cell ? 1 : 0;
}

double StreamFileReader::fraction() const
{
  return this->Input.size() > 0
           ? static_cast<double>(this->Input.position()) / static_cast<double>(this->Input.size())
           : 1.0;
}

void StreamFileReader::fail(const std::string& what) const
{
  throw Error(this->Input.name() + ": " + this->place() + ": " + what);
}

void StreamFileReader::checkEnd() const
{
  const StreamFileHeader& header = this->Header;
  const bool vertices = header.vertices >= 0 && this->Vertices != header.vertices;
  const bool cells = header.cells >= 0 && this->Cells != header.cells;
  if (vertices || cells)
  {
    this->fail("the file ends with " + std::to_string(vertices ? this->Vertices : this->Cells) +
               (vertices ? " vertices" : " cells") + ", but its header says " +
               std::to_string(vertices ? header.vertices : header.cells) +
               ": it is truncated or damaged.");
  }
  if (this->Cells == 0)
  {
    this->fail("the file ends without a cell.");
  }
}

std::unique_ptr<StreamFileReader> openStreamFile(const std::filesystem::path& path)
{
  const StreamFormat format = detectStreamFormat(path);
  if (isText(format))
  {
    return std::make_unique<TextStreamReader>(path, format);
  }
  return std::make_unique<BinaryStreamReader>(path, format);
}

} // namespace smg
