// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionEstimate.h"

#include "IO/Container/VsmReader.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Import/Importer.h"
#include "IO/Import/PlyHeader.h"
#include "Solver/Core/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace smg
{

namespace
{

/** What a file says, or its size lets guess. */
struct Counts
{
  std::int64_t vertices = 0, cells = 0;
  int corners = 3;
  std::int64_t columnBytes = 0; ///< of all columns of the mesh
  bool counted = false;
};

/** Bytes that a vertex takes in a file, with the cells that come to it: two triangles, six tets. */
struct Share
{
  std::int64_t bytes;
  int corners;
};

Share shareOf(MeshFormat format)
{
  switch (format)
  {
    case MeshFormat::Stl:
      return { 100, 3 };
    case MeshFormat::Medit:
    case MeshFormat::TetGen:
      return { 200, 4 };
    case MeshFormat::Gmsh:
      return { 250, 4 };
    case MeshFormat::VtkLegacy:
    case MeshFormat::VtkXml:
    case MeshFormat::VtkParallelXml:
      return { 45, 3 };
    default:
      return { 75, 3 };
  }
}

std::int64_t columnBytes(const StreamInfo& info)
{
  std::int64_t bytes = 0;
  for (const ColumnSpec& spec : info.vertexColumns)
  {
    bytes += info.vertices * static_cast<std::int64_t>(spec.tupleBytes());
  }
  for (const ColumnSpec& spec : info.cellColumns)
  {
    bytes += info.cells * static_cast<std::int64_t>(spec.tupleBytes());
  }
  return bytes;
}

Counts countsOfPly(const std::filesystem::path& path)
{
  InputFile file(path);
  Counts counts;
  counts.counted = true;
  for (const PlyElement& element : readPlyHeader(file).elements)
  {
    std::int64_t bytes = 0;
    for (const PlyProperty& property : element.properties)
    {
      bytes += property.list ? 0 : static_cast<std::int64_t>(sizeOf(property.type));
    }
    if (element.name == "vertex")
    {
      counts.vertices = element.count;
      counts.columnBytes += element.count * std::max<std::int64_t>(bytes - 12, 0);
    }
    else if (element.name == "face")
    {
      counts.cells = element.count;
      counts.columnBytes += element.count * bytes;
    }
  }
  return counts;
}

Counts guess(const std::filesystem::path& path)
{
  const Share share = shareOf(meshFormat(path));
  Counts counts;
  counts.corners = share.corners;
  counts.vertices = static_cast<std::int64_t>(std::filesystem::file_size(path)) / share.bytes;
  counts.cells = counts.vertices * (share.corners == 3 ? 2 : 6);
  return counts;
}

Counts countsOf(const std::filesystem::path& path)
{
  switch (kindOfInput(path))
  {
    case MeshFileKind::Vsm:
    {
      const StreamInfo info = VsmReader(path).info();
      return { info.vertices, info.cells, cornersOf(info.cellType), columnBytes(info), true };
    }
    case MeshFileKind::Indexed:
      return meshFormat(path) == MeshFormat::Ply ? countsOfPly(path) : guess(path);
    case MeshFileKind::Stream:
      return guess(path);
    default:
      throw Error(path.string() + ": the format is not known by its content or suffix.");
  }
}

std::filesystem::path scratchFolder(const std::filesystem::path& folder)
{
  return folder.empty() ? std::filesystem::temp_directory_path() : folder;
}

} // namespace

std::int64_t scratchBytes(
  std::int64_t vertices, std::int64_t cells, int corners, std::int64_t columnBytes)
{
  // The mesh as it was parsed, pages, and cells by their places, of which the last two do not
  // overlap with all that comes before them; columns twice while they are brought into order.
  constexpr std::int64_t VertexBytes = 110;
  constexpr std::int64_t CornerBytes = 18;
  return vertices * VertexBytes + cells * corners * CornerBytes + 2 * columnBytes;
}

void checkScratchRoom(const std::filesystem::path& folder, std::int64_t bytes)
{
  const std::filesystem::path place = scratchFolder(folder);
  std::error_code unknown;
  const std::filesystem::space_info room = std::filesystem::space(place, unknown);
  if (!unknown && static_cast<std::int64_t>(room.available) < bytes)
  {
    const auto mebibytes = [](std::int64_t count) { return std::to_string((count >> 20) + 1); };
    throw Error(place.string() + ": the scratch files take about " + mebibytes(bytes) +
                " MiB, there is room for " + mebibytes(static_cast<std::int64_t>(room.available)) +
                " MiB: choose another folder for them (option --scratch).");
  }
}

ConversionEstimate estimateConversion(
  const std::filesystem::path& in, const ConversionOptions& options)
{
  const Counts counts = countsOf(in);
  ConversionEstimate estimate;
  estimate.vertices = counts.vertices;
  estimate.cells = counts.cells;
  estimate.counted = counts.counted;
  estimate.memory_bytes =
    options.memoryLimit > 0 ? options.memoryLimit : ConversionOptions::DefaultMemory;
  estimate.scratch_bytes =
    scratchBytes(counts.vertices, counts.cells, counts.corners, counts.columnBytes);
  std::error_code unknown;
  estimate.scratch_free = static_cast<std::int64_t>(
    std::filesystem::space(scratchFolder(options.scratch), unknown).available);
  constexpr double OutputBytes = 11.0;
  constexpr double SecondsOfVertex = 1.0e-6;
  constexpr double SecondsOfCorner = 0.3e-6;
  const auto corners = static_cast<double>(counts.cells * counts.corners);
  const auto vertices = static_cast<double>(counts.vertices);
  estimate.output_bytes = static_cast<std::int64_t>(
    vertices * OutputBytes + corners * 2.0 + static_cast<double>(counts.columnBytes));
  estimate.cpu_seconds = vertices * SecondsOfVertex + corners * SecondsOfCorner;
  return estimate;
}

std::string ConversionEstimate::json(int indent) const
{
  nlohmann::ordered_json json;
  json["vertices"] = this->vertices;
  json["cells"] = this->cells;
  json["counted"] = this->counted;
  json["memory_bytes"] = this->memory_bytes;
  json["scratch_bytes"] = this->scratch_bytes;
  json["scratch_free"] = this->scratch_free;
  json["output_bytes"] = this->output_bytes;
  json["cpu_seconds"] = this->cpu_seconds;
  return json.dump(indent);
}

} // namespace smg
