// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFile.h"

#include "IO/Files/Suffix.h"
#include "IO/Files/Tokens.h"
#include "IO/Formats/Streams/BinaryStreamHeader.h"
#include "IO/Formats/Streams/BinaryStreamReader.h"
#include "IO/Formats/Streams/TextStreamReader.h"
#include "smg/Error.h"

#include <algorithm>
#include <cctype>

namespace smg
{

namespace
{

/** The maximum number of lines read to distinguish the text formats. */
constexpr int LinesLookedAt = 10000;

/** The text format, by the first line that only one of them can have. */
std::optional<StreamFormat> detectText(SequentialInput& input)
{
  std::string_view line;
  for (int i = 0; i < LinesLookedAt && input.nextLine(line); i++)
  {
    Tokens tokens(line);
    const std::string_view first = tokens.word();
    // A comment with data of the mesh; its other words are arbitrary.
    const std::string_view key = first == "#" ? tokens.word() : std::string_view();
    if (first == "f" || key == "nfaces")
    {
      return StreamFormat::Sma;
    }
    if (first == "c" || key == "ncells" || key == "svtype" || key == "v_pnum_f")
    {
      return StreamFormat::Sva;
    }
  }
  return {};
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
  if (isCompressed || suffix == ".smc" || suffix == ".smd" || suffix == ".svc")
  {
    const std::string name = suffix == ".svc" ? "SVC" : first == 2 ? "SMD" : "SMC";
    refuse("is in the compressed format " + name +
           ", which is not read: convert it to SMB or SVB with the program that made it.");
  }
  if (first == SmbVersion || first == SvbVersion)
  {
    return first == SmbVersion ? StreamFormat::Smb : StreamFormat::Svb;
  }
  const auto byName = streamFormatOfName(path);
  const auto byText = detectText(input);
  if (!byText && !(byName && isText(*byName)))
  {
    refuse("is none of the formats SMA, SMB, SVA and SVB, or is damaged in its first bytes.");
  }
  return byName && isText(*byName) ? *byName : *byText;
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
