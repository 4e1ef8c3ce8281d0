// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <algorithm>
#include <span>
#include <vector>

namespace smg
{

namespace
{

// Formats without a signature are ordered by increasing risk of confusion with others.
constexpr const Format* Formats[] = {
  &VsmFileFormat,
  &StreamsFormat,
  &PlyFormat,
  &StlFormat,
  &ObjFormat,
  &OffFormat,
  &MeditFormat,
  &BinaryMeditFormat,
  &GmshFormat,
  &TetGenFormat,
  &AbaqusFormat,
  &NastranFormat,
  &MfemFormat,
  &NetgenFormat,
  &ExodusFormat,
  &LegacyVtkFormat,
  &VtkXmlFormat,
  &ParallelVtkXmlFormat,
  &VtkHdfFormat,
};

/** The first bytes of a file, uncompressed. */
struct FileStart
{
  std::string bytes;
  std::optional<std::uint64_t> size; ///< of the file; none if it is compressed
};

/** The start of a regular file; empty if it cannot be read. */
FileStart startOf(const std::filesystem::path& path)
{
  FileStart start{ std::string(FormatBytes, '\0'), {} };
  try
  {
    const FileDescriptor file = FileDescriptor::openForReading(path);
    start.bytes.resize(file.readSome(0, std::as_writable_bytes(std::span(start.bytes))));
    start.size = static_cast<std::uint64_t>(file.size());
  }
  // Whoever reads the file gets the error.
  catch (const Error&)
  {
    return {};
  }
  if (compressionOf(start.bytes) != Compression::None)
  {
    start = { inflateStart(start.bytes, FormatBytes), {} };
  }
  return start;
}

template <class Test>
const Format* firstOf(Test&& test)
{
  const auto* const found =
    std::ranges::find_if(Formats, [&](const Format* format) { return test(*format); });
  return found == std::end(Formats) ? nullptr : *found;
}

const Format* formatByMagic(std::string_view start)
{
  return firstOf([&](const Format& format) { return format.hasMagic && format.hasMagic(start); });
}

const Format* formatByLook(std::string_view start, std::optional<std::uint64_t> size)
{
  return firstOf(
    [&](const Format& format) { return format.looksLike && format.looksLike(start, size); });
}

bool canBeUsed(const Format& format, FormatUse use)
{
  const bool writes = format.kind == MeshFileKind::Vsm || format.writeVsm || format.writer;
  switch (use)
  {
    case FormatUse::Read:
      return format.parse || format.kind != MeshFileKind::Indexed;
    case FormatUse::Write:
      return writes;
    case FormatUse::WriteColumns:
      return writes && format.holdsColumns;
    case FormatUse::WriteEither:
      return writes && format.suffixes.front().form == FileForm::Either;
    case FormatUse::Restore:
      return format.writer != nullptr;
    case FormatUse::RestoreColumns:
      return format.writer && format.holdsColumns;
  }
  return false;
}

template <class Test>
std::string suffixesOf(std::span<const FormatUse> uses, std::string_view conjunction, Test&& test)
{
  std::vector<std::string_view> suffixes;
  for (const Format* format : Formats)
  {
    for (const FileSuffix& suffix : format->suffixes)
    {
      const auto can = [format](FormatUse use) { return canBeUsed(*format, use); };
      if (std::ranges::any_of(uses, can) && test(suffix))
      {
        suffixes.push_back(suffix.text);
      }
    }
  }
  return listed(suffixes, std::string(conjunction));
}

} // namespace

std::span<const Format* const> formats()
{
  return Formats;
}

const Format* formatOfSuffix(std::string_view suffix)
{
  return firstOf(
    [&](const Format& format) {
      return std::ranges::find(format.suffixes, suffix, &FileSuffix::text) != format.suffixes.end();
    });
}

const Format* formatOfName(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  return formatOfSuffix(isCompressedSuffix(suffix) ? lowerSuffix(path.stem()) : suffix);
}

const Format* formatOfContent(const std::filesystem::path& path)
{
  return formatByMagic(startOf(path).bytes);
}

const Format* formatByContent(const std::filesystem::path& path)
{
  const FileStart start = startOf(path);
  return formatByLook(start.bytes, start.size);
}

const Format* formatOfStart(
  std::string_view start, std::optional<std::uint64_t> size, const std::filesystem::path& path)
{
  if (const Format* format = formatByMagic(start))
  {
    return format;
  }
  const Format* format = formatByLook(start, size);
  format = format ? format : formatOfName(path);
  return format && format->kind == MeshFileKind::Indexed ? format : nullptr;
}

bool isKnownByContent(std::string_view start, std::optional<std::uint64_t> size)
{
  return formatByMagic(start) || formatByLook(start, size);
}

const Format* formatOfFile(const std::filesystem::path& path)
{
  const FileStart start = startOf(path);
  return formatOfStart(start.bytes, start.size, path);
}

const FileSuffix* suffixFor(FormatUse use, const std::filesystem::path& path)
{
  const std::string text = lowerSuffix(path);
  const Format* const format = formatOfSuffix(text);
  return format && canBeUsed(*format, use)
           ? &*std::ranges::find(format->suffixes, std::string_view(text), &FileSuffix::text)
           : nullptr;
}

bool restoresColumns(const std::filesystem::path& path, std::span<const std::string> columns)
{
  const Format* const format = formatOfSuffix(lowerSuffix(path));
  const auto hasPlace = [format](const std::string& column)
  { return std::ranges::find(format->vertexColumns, column) != format->vertexColumns.end(); };
  return format && format->writer &&
         (format->holdsColumns || std::ranges::all_of(columns, hasPlace));
}

std::string suffixList(const Format& format, std::string_view conjunction)
{
  std::vector<std::string_view> suffixes;
  for (const FileSuffix& suffix : format.suffixes)
  {
    suffixes.push_back(suffix.text);
  }
  return listed(suffixes, std::string(conjunction));
}

std::string suffixList(FormatUse use, std::string_view conjunction)
{
  return suffixesOf({ &use, 1 }, conjunction, [](const FileSuffix&) { return true; });
}

std::string suffixList(FormatUse use, CellType cells, std::string_view conjunction)
{
  return suffixList({ &use, 1 }, cells, conjunction);
}

std::string suffixList(
  std::span<const FormatUse> uses, std::optional<CellType> cells, std::string_view conjunction)
{
  return suffixesOf(uses, conjunction,
    [cells](const FileSuffix& suffix) { return !cells || suffix.holds(*cells); });
}

void checkHolds(const std::filesystem::path& path, const FileSuffix& suffix, CellType cells,
  const std::string& choices)
{
  if (!suffix.holds(cells))
  {
    throw Error(path.string() + ": a " + std::string(suffix.text) + " file holds no " +
                (cells == CellType::Triangle ? "triangles" : "tetrahedra") + ": choose " + choices +
                '.');
  }
}

void checkForm(const std::filesystem::path& path, bool text)
{
  const std::string name = lowerSuffix(path);
  const Format* const format = text ? formatOfSuffix(name) : nullptr;
  if (format &&
      std::ranges::find(format->suffixes, std::string_view(name), &FileSuffix::text)->form ==
        FileForm::Binary)
  {
    const FormatUse written = FormatUse::Write;
    throw Error(path.string() + ": a " + name + " file is not written as text: choose " +
                suffixesOf({ &written, 1 }, "or",
                  [](const FileSuffix& other) { return other.form != FileForm::Binary; }) +
                ", or do not ask for text.");
  }
}

} // namespace smg
