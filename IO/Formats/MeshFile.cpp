// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/MeshFile.h"

#include "IO/External/BlockFile.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Foreign/ForeignFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/UsedFiles.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <unistd.h>

namespace smg
{
namespace
{

/** The kind of a file by its content; Unknown if that says nothing. */
MeshFileKind kindOfContent(const std::filesystem::path& path)
{
  if (isBlockFile(path))
  {
    return MeshFileKind::Vsm;
  }
  if (formatOfContent(path))
  {
    return MeshFileKind::Indexed;
  }
  const Resemblance stream = resemblanceToStream(path);
  const Format* const indexed = formatByContent(path);
  if (stream == Resemblance::None || !indexed)
  {
    const bool isStream = stream != Resemblance::None;
    return isStream ? MeshFileKind::Stream
                    : (indexed ? MeshFileKind::Indexed : MeshFileKind::Unknown);
  }
  // Both forms: a STL file may begin with any bytes, and text may be OBJ or SMA. The name decides.
  if (stream == Resemblance::Sure)
  {
    return formatOfName(path) == indexed ? MeshFileKind::Indexed : MeshFileKind::Stream;
  }
  return isStreamSuffix(lowerSuffix(path)) ? MeshFileKind::Stream : MeshFileKind::Indexed;
}

void import(InputFile& file, const Format* format, RawMeshBuilder& builder,
  const ImportOptions& options, const ProgressFunction& progress)
{
  if (!format)
  {
    throw Error(file.name() + ": the format is not known by its content or suffix: meshes are " +
                "read from " + suffixList(FormatUse::Read, "and") +
                " files, which may be compressed by gzip, xz or zstd.");
  }
  if (!format->hasParts)
  {
    checkIsWhole(options.part, file.name());
  }
  if (std::ranges::none_of(format->suffixes, &FileSuffix::tetrahedra))
  {
    builder.expectSurface();
  }
  format->parse(file, builder, options.part, progress);
}

/** Passes a file that is not compressed to the builder, and calls `finish`. */
template <class Finish>
void importInflated(InputFile& file, RawMeshBuilder& builder, const ImportOptions& options,
  const ProgressFunction& progress, const Finish& finish)
{
  const std::string start(file.at(0, FormatBytes).substr(0, FormatBytes));
  // The name of the file before decompression, with its suffix.
  const Format* const format = formatOfStart(start, file.size(), file.name());
  refuseForeignMesh(file.name(), start, file.size(), format);
  try
  {
    import(file, format, builder, options, progress);
    finish();
  }
  catch (const MeshError& error)
  {
    throw Error(file.name() + ": " + error.what() + '.');
  }
}

/** Passes a file to the builder, and calls `finish`. */
template <class Finish>
void importFile(const std::filesystem::path& path, RawMeshBuilder& builder,
  const ImportOptions& options, const Finish& finish)
{
  constexpr double inflatingShare = 0.3;
  std::optional<InflatedFile> inflated;
  {
    InputFile file(path, partOf(options.progress, 0.0, inflatingShare));
    if (isCompressed(file))
    {
      inflated.emplace(file, builder.workspace(), "inflated");
    }
  }
  const ProgressFunction progress =
    inflated ? partOf(options.progress, inflatingShare, 1.0) : options.progress;
  InputFile file(inflated ? inflated->path() : path, progress, path.string());
  importInflated(file, builder, options, progress, finish);
}

} // namespace

MeshFileKind kindOfInput(const std::filesystem::path& path)
{
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
  {
    const MeshFileKind kind = kindOfContent(path);
    if (kind != MeshFileKind::Unknown)
    {
      return kind;
    }
  }
  const std::string suffix = lowerSuffix(path);
  if (isStreamSuffix(suffix))
  {
    return MeshFileKind::Stream;
  }
  const Format* const named = formatOfName(path);
  return suffix == ".vsm" ? MeshFileKind::Vsm
                          : (named && named->kind == MeshFileKind::Indexed ? MeshFileKind::Indexed
                                                                           : MeshFileKind::Unknown);
}

std::vector<double> timesOf(const std::filesystem::path& path)
{
  std::error_code absent;
  const Format* const format =
    std::filesystem::is_regular_file(path, absent) ? formatOfFile(path) : nullptr;
  return format && format->times ? format->times(path) : std::vector<double>{};
}

MeshFileKind kindOfOutput(const std::filesystem::path& path)
{
  return suffixFor(FormatUse::Write, path) ? formatOfName(path)->kind : MeshFileKind::Unknown;
}

void checkOutput(const std::filesystem::path& path)
{
  if (!suffixFor(FormatUse::Write, path))
  {
    throw Error(path.string() + ": meshes are written as " + suffixList(FormatUse::Write, "or") +
                ": choose such a suffix.");
  }
  checkOutputPlace(path);
}

void checkOutput(const std::filesystem::path& path, CellType cellType)
{
  checkOutput(path);
  const FileSuffix& suffix = *suffixFor(FormatUse::Write, path);
  checkHolds(path, suffix, cellType, suffixList(FormatUse::Write, cellType, "or"));
}

void checkOutputPlace(const std::filesystem::path& path)
{
  // A folder that is not accessible is reported below.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
  {
    throw Error(path.string() + ": this is a folder: choose the name of a file.");
  }
  const std::filesystem::path target = FileDescriptor::targetOf(path);
  if (std::filesystem::exists(target, ignored) &&
      !std::filesystem::is_regular_file(target, ignored))
  {
    throw Error(path.string() + ": this is a device or a pipe: choose the name of a file.");
  }
  const std::filesystem::path parent = target.parent_path();
  const std::filesystem::path folder = parent.empty() ? std::filesystem::path(".") : parent;
  if (!std::filesystem::is_directory(folder, ignored))
  {
    throw Error(path.string() + ": there is no folder " + folder.string() + '.');
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
  {
    throw Error(path.string() + ": no file can be made in the folder " + folder.string() + ": " +
                std::strerror(errno) + '.');
  }
}

void checkIsNotInput(
  const std::filesystem::path& in, const std::filesystem::path& out, const std::string& what)
{
  UsedFiles files;
  files.readMesh(in, what);
  files.writeMesh(out);
  files.check();
}

void refuseForeignMesh(const std::string& name, std::string_view start,
  std::optional<std::uint64_t> size, const Format* format)
{
  if (!isKnownByContent(start, size))
  {
    refuseForeign(name, start, format);
  }
}

RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options)
{
  RawMeshBuilder builder(workspace, options.cells);
  std::optional<RawMesh> mesh;
  importFile(path, builder, options, [&] { mesh = builder.finish(); });
  return std::move(*mesh);
}

StreamInfo lookAtMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options)
{
  RawMeshBuilder builder(workspace, options.cells, RawMeshBuilder::Look);
  try
  {
    importFile(path, builder, options, [&] { builder.finish(); });
  }
  catch (const CellTypeFound& cells)
  {
    return builder.found(cells);
  }
  throw Error(path.string() + ": the file has no cells.");
}

} // namespace smg
