// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/MeshFile.h"

#include "IO/Container/VsmReader.h"
#include "IO/Formats/StreamFile.h"
#include "Solver/Storage/BlockFile.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace smg
{

namespace
{

std::string lowerSuffix(const std::filesystem::path& path)
{
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

std::int64_t bytesOf(const std::vector<ColumnSpec>& specs)
{
  std::size_t bytes = 0;
  for (const ColumnSpec& spec : specs)
  {
    bytes += spec.tupleBytes();
  }
  return static_cast<std::int64_t>(bytes);
}

std::vector<Column> emptyColumns(const std::vector<ColumnSpec>& specs, std::int64_t tuples)
{
  std::vector<Column> columns;
  for (const ColumnSpec& spec : specs)
  {
    columns.push_back({ spec, {} });
    columns.back().bytes.reserve(spec.tupleBytes() * static_cast<std::size_t>(tuples));
  }
  return columns;
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
  if (std::filesystem::is_regular_file(path) && isBlockFile(path))
  {
    return MeshFileKind::Vsm;
  }
  const std::string suffix = lowerSuffix(path);
  if (suffix == ".vsm")
  {
    return MeshFileKind::Vsm;
  }
  constexpr std::string_view streams[] = { ".sma", ".smb", ".smc", ".smd", ".sva", ".svb", ".svc" };
  return std::find(std::begin(streams), std::end(streams), suffix) != std::end(streams)
           ? MeshFileKind::Stream
           : MeshFileKind::Indexed;
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
  return streamFormatOfName(path) ? MeshFileKind::Stream : MeshFileKind::Unknown;
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
  mesh.vertexColumns = emptyColumns(info.vertexColumns, info.vertices);
  mesh.cellColumns = emptyColumns(info.cellColumns, info.cells);
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
