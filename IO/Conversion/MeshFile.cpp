// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/MeshFile.h"

#include "IO/Container/Columns.h"
#include "IO/Container/VsmReader.h"
#include "IO/Formats/StreamConversion.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Formats/Suffix.h"
#include "IO/Import/Importer.h"
#include "IO/Output/WritePly.h"
#include "IO/Output/WriteVtkXml.h"
#include "Solver/Core/Error.h"
#include "Solver/Storage/BlockFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include <unistd.h>

namespace smg
{

namespace
{

std::int64_t bytesOf(const std::vector<ColumnSpec>& specs)
{
  std::size_t bytes = 0;
  for (const ColumnSpec& spec : specs)
  {
    bytes += spec.tupleBytes();
  }
  return static_cast<std::int64_t>(bytes);
}

/** Whether the content of a file is that of a streaming format, whatever its name. */
bool looksLikeStream(const std::filesystem::path& path)
{
  try
  {
    detectStreamFormat(path);
    return true;
  }
  catch (const Error&)
  {
    return false;
  }
}

void append(const std::vector<Column>& from, std::vector<Column>& to)
{
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    to[i].bytes.insert(to[i].bytes.end(), from[i].bytes.begin(), from[i].bytes.end());
  }
}

} // namespace

MeshFileKind kindOfInput(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  std::error_code ignored;
  const bool isFile = std::filesystem::is_regular_file(path, ignored);
  if (suffix == ".vsm" || (isFile && isBlockFile(path)))
  {
    return MeshFileKind::Vsm;
  }
  if (isFile && meshFormatOfContent(path) != MeshFormat::Unknown)
  {
    return MeshFileKind::Indexed;
  }
  constexpr std::string_view streams[] = { ".sma", ".smb", ".smc", ".smd", ".sva", ".svb", ".svc" };
  // A binary STL file begins with anything, and an OBJ file may look like a streaming one.
  const bool saysNothing = suffix == ".stl" || suffix == ".obj";
  if (std::find(std::begin(streams), std::end(streams), suffix) != std::end(streams) ||
      (isFile && !saysNothing && looksLikeStream(path)))
  {
    return MeshFileKind::Stream;
  }
  return meshFormat(path) == MeshFormat::Unknown ? MeshFileKind::Unknown : MeshFileKind::Indexed;
}

MeshFileKind kindOfOutput(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  if (suffix == ".vsm")
  {
    return MeshFileKind::Vsm;
  }
  if (suffix == ".vtp" || suffix == ".vtu")
  {
    return MeshFileKind::VtkXml;
  }
  if (suffix == ".ply")
  {
    return MeshFileKind::Ply;
  }
  return streamFormatOfName(path) ? MeshFileKind::Stream : MeshFileKind::Unknown;
}

void checkOutput(const std::filesystem::path& path)
{
  if (kindOfOutput(path) == MeshFileKind::Unknown)
  {
    throw Error(path.string() + ": meshes are written as .vsm, .sma, .smb, .sva, .svb, .ply, .vtp "
                                "or .vtu: choose a name that ends so.");
  }
  // A folder that cannot be looked into is told of below.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
  {
    throw Error(path.string() + ": this is a folder: choose the name of a file.");
  }
  const std::filesystem::path folder =
    path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
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

void checkOutput(const std::filesystem::path& path, CellType cellType)
{
  checkOutput(path);
  switch (kindOfOutput(path))
  {
    case MeshFileKind::VtkXml:
      checkVtkXmlPath(path, cellType);
      break;
    case MeshFileKind::Ply:
      checkPlyPath(path, cellType);
      break;
    case MeshFileKind::Stream:
      checkStreamPath(path, cellType);
      break;
    default:
      break;
  }
}

IndexedMesh loadVsm(
  const std::filesystem::path& path, const MemoryBudget& budget, const ProgressFunction& progress)
{
  const VsmReader reader(path);
  const StreamInfo& info = reader.info();
  MeshSizes sizes;
  sizes.vertices = info.vertices;
  sizes.cells = info.cells;
  sizes.corners = cornersOf(info.cellType);
  sizes.vertexColumnBytes = bytesOf(info.vertexColumns);
  sizes.cellColumnBytes = bytesOf(info.cellColumns);
  budget.check(path, sizes);

  IndexedMesh mesh;
  mesh.cellType = info.cellType;
  mesh.doublePositions = info.doublePositions;
  mesh.positions.reserve(static_cast<std::size_t>(info.vertices) * 3);
  mesh.corners.reserve(static_cast<std::size_t>(info.cells * sizes.corners));
  mesh.vertexColumns = emptyColumns(info.vertexColumns, static_cast<std::size_t>(info.vertices));
  mesh.cellColumns = emptyColumns(info.cellColumns, static_cast<std::size_t>(info.cells));
  Progress reported(progress);
  const std::unique_ptr<MeshSource> source = reader.source();
  for (MeshBlock block; source->next(block);)
  {
    mesh.positions.insert(mesh.positions.end(), block.positions.begin(), block.positions.end());
    mesh.corners.insert(mesh.corners.end(), block.corners.begin(), block.corners.end());
    append(block.vertexColumns, mesh.vertexColumns);
    append(block.cellColumns, mesh.cellColumns);
    reported.update(static_cast<double>(mesh.cells()) / static_cast<double>(info.cells));
  }
  return mesh;
}

} // namespace smg
