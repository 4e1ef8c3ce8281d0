// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Importer.h"

#include "IO/Conversion/PartialProgress.h"
#include "IO/Import/FormatOfBytes.h"
#include "IO/Import/Formats.h"
#include "IO/Import/Inflate.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace smg
{

namespace
{

std::atomic<VtkImporter> TheVtkImporter{ nullptr };

/** What the first bytes of a file are, without compression. */
struct FileStart
{
  std::string bytes;
  std::optional<std::uint64_t> size; ///< of the file; none if it is compressed
};

/** Of a file that cannot be read, nothing. */
FileStart startOf(const std::filesystem::path& path)
{
  FileStart start{ std::string(FormatBytes, '\0'), {} };
  std::ifstream stream(path, std::ios::binary);
  stream.read(start.bytes.data(), static_cast<std::streamsize>(FormatBytes));
  start.bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (isGzip(start.bytes))
  {
    start.bytes = inflateStart(start.bytes, FormatBytes);
    return start;
  }
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error)
  {
    start.size = size;
  }
  return start;
}

MeshFormat formatOf(const FileStart& start, const std::filesystem::path& path)
{
  MeshFormat format = formatOfSign(start.bytes);
  format = format == MeshFormat::Unknown ? formatOfLooks(start.bytes, start.size) : format;
  return format == MeshFormat::Unknown ? formatOfSuffix(path) : format;
}

void import(
  InputFile& file, MeshFormat format, RawMeshBuilder& builder, const ProgressFunction& progress)
{
  switch (format)
  {
    case MeshFormat::Ply:
      return importPly(file, builder);
    case MeshFormat::Obj:
      return importObj(file, builder);
    case MeshFormat::Off:
      return importOff(file, builder);
    case MeshFormat::Stl:
      return importStl(file, builder);
    case MeshFormat::Medit:
      return importMedit(file, builder);
    case MeshFormat::Gmsh:
      return importGmsh(file, builder);
    case MeshFormat::TetGen:
      return importTetGen(file, builder);
    case MeshFormat::VtkLegacy:
      return importLegacyVtk(file, builder);
    case MeshFormat::VtkXml:
      return importVtkXml(file, builder, progress);
    case MeshFormat::VtkParallelXml:
      return importParallelVtkXml(file, builder, progress);
    case MeshFormat::Unknown:
      throw Error(file.name() +
                  ": the format is not known by its content or suffix: meshes are read from .vsm, "
                  ".sma, .smb, .sva, .svb, .ply, .obj, .off, .stl, .mesh, .msh, .node, .ele, .vtk, "
                  ".vtp, .vtu, .pvtp and .pvtu files, which may be compressed by gzip.");
  }
}

RawMesh importInflated(
  InputFile& file, Workspace& workspace, CellChoice cells, const ProgressFunction& progress)
{
  // The name is the one that the file had before it was inflated, and has its suffix.
  const FileStart start{ std::string(file.at(0, FormatBytes).substr(0, FormatBytes)), file.size() };
  try
  {
    RawMeshBuilder builder(workspace, cells);
    import(file, formatOf(start, file.name()), builder, progress);
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(file.name() + ": " + error.what() + '.');
  }
}

} // namespace

void setVtkImporter(VtkImporter importer)
{
  TheVtkImporter = importer;
}

VtkImporter vtkImporter()
{
  return TheVtkImporter;
}

MeshFormat meshFormatOfContent(const std::filesystem::path& path)
{
  return formatOfSign(startOf(path).bytes);
}

MeshFormat meshFormat(const std::filesystem::path& path)
{
  return formatOf(startOf(path), path);
}

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
  return importInflated(file, workspace, options.cells, progress);
}

} // namespace smg
