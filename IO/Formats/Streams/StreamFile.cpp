// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamFile.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/Foreign/ForeignFile.h"
#include "IO/Mesh/Format.h"
#include "smg/Error.h"

#include <algorithm>
#include <iterator>

namespace smg
{

namespace
{

/** The first four are those of StreamFormat, the others those of formats that are not read. */
constexpr std::string_view StreamFileSuffixes[] = { ".sma", ".smb", ".sva", ".svb", ".smc", ".smd",
  ".svc" };
constexpr std::ptrdiff_t SupportedFormats = 4;

std::ptrdiff_t placeOf(std::string_view suffix)
{
  return std::ranges::find(StreamFileSuffixes, suffix) - StreamFileSuffixes;
}

} // namespace

std::optional<StreamFormat> streamFormatOfName(const std::filesystem::path& path)
{
  const std::ptrdiff_t place = placeOf(lowerSuffix(path));
  return place < SupportedFormats ? std::optional(static_cast<StreamFormat>(place)) : std::nullopt;
}

bool isStreamSuffix(std::string_view suffix)
{
  return placeOf(suffix) < std::ssize(StreamFileSuffixes);
}

StreamFormat detectStreamFormat(const std::filesystem::path& path)
{
  InputFile file(path);
  const std::string start(file.at(0, FormatBytes).substr(0, FormatBytes));
  const auto refuse = [&path](const std::string& what)
  { throw Error(path.string() + ": " + what); };
  if (start.starts_with("\x1f\x8b"))
  {
    refuse("is compressed with gzip, which is not read: unpack it first.");
  }
  const auto first = static_cast<unsigned char>(start[0]);
  if (first == SmbVersion || first == SvbVersion)
  {
    return first == SmbVersion ? StreamFormat::Smb : StreamFormat::Svb;
  }
  const std::string suffix = lowerSuffix(path);
  const auto byName = streamFormatOfName(path);
  const bool isCompressed = first >= 1 && first <= 3;
  std::optional<StreamFormat> byText;
  if (!isCompressed)
  {
    refuseForeign(path.string(), start,
      byName ? "an " + std::string(nameOf(*byName)) + " file" : std::string("a mesh stream"));
    byText = formatOfText(file);
  }
  if (isCompressed || (!byText && !byName && isStreamSuffix(suffix)))
  {
    const std::string name = suffix == ".svc" ? "SVC" : first == 2 ? "SMD" : "SMC";
    refuse("is in the compressed format " + name +
           ", which is not read: convert it to SMB or SVB with the program that made it.");
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
    InputFile file(path);
    const auto first = static_cast<unsigned char>(file.at(0).front());
    if (first != SmbVersion && first != SvbVersion)
    {
      return resemblanceOfText(file);
    }
    // Many binary files begin with a zero: the rest of the header has to make sense, too.
    const StreamFileHeader header =
      readBinaryHeader(file, first == SmbVersion ? StreamFormat::Smb : StreamFormat::Svb);
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

void StreamFileReader::fail(const std::string& what) const
{
  throw Error(this->name() + ": " + this->place() + ": " + what);
}

std::optional<std::int64_t> StreamFileReader::vertexOf(std::int64_t index, std::int64_t most) const
{
  const StreamFileHeader& header = this->Header;
  const bool isRelative = index < 0;
  const std::int64_t vertex = isRelative ? this->Vertices + index : index - 1;
  // In post-order the vertices are still to come.
  const std::int64_t end = !header.postOrder      ? this->Vertices
                           : header.vertices >= 0 ? std::min(header.vertices, most)
                                                  : most;
  const bool isValid = vertex >= 0 && vertex < end && !(isRelative && header.postOrder);
  return isValid ? std::optional(vertex) : std::nullopt;
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

std::unique_ptr<StreamFileReader> openStreamFile(
  const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamFormat format = detectStreamFormat(path);
  return isText(format) ? openTextStream(path, format, progress)
                        : openBinaryStream(path, format, progress);
}

} // namespace smg
