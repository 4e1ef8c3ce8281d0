// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Importer.h"

#include "IO/Files/Inflate.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "smg/Error.h"

#include <optional>
#include <string>

namespace smg
{

namespace
{

void import(InputFile& file, const Format* format, RawMeshBuilder& builder,
  const ImportOptions& options, const ProgressFunction& progress)
{
  if (!format)
  {
    throw Error(file.name() + ": the format is not known by its content or suffix: meshes are " +
                "read from " + suffixList(FormatUse::Read, "and") +
                " files, which may be compressed by gzip.");
  }
  if (!format->hasParts)
  {
    checkIsWhole(options.part, file.name());
  }
  format->parse(file, builder, options.part, progress);
}

RawMesh importInflated(InputFile& file, Workspace& workspace, const ImportOptions& options,
  const ProgressFunction& progress)
{
  // The name of the file before decompression, with its suffix.
  const Format* const format = formatOfStart(
    std::string(file.at(0, FormatBytes).substr(0, FormatBytes)), file.size(), file.name());
  try
  {
    RawMeshBuilder builder(workspace, options.cells);
    import(file, format, builder, options, progress);
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(file.name() + ": " + error.what() + '.');
  }
}

} // namespace

RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options)
{
  constexpr double inflatingShare = 0.3;
  std::optional<InflatedFile> inflated;
  {
    InputFile file(path, partOf(options.progress, 0.0, inflatingShare));
    if (isGzip(file.at(0, 2)))
    {
      inflated.emplace(file, workspace, "inflated");
    }
  }
  const ProgressFunction progress =
    inflated ? partOf(options.progress, inflatingShare, 1.0) : options.progress;
  InputFile file(inflated ? inflated->path() : path, progress, path.string());
  return importInflated(file, workspace, options, progress);
}

} // namespace smg
