// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionEstimate.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/Conversion/CompressedStream.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Streams/StreamsFormat.h"
#include "Solver/Core/ByteText.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace smg
{

namespace
{

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

/** The uncompressed size of a gzip file: its last four bytes store it modulo 2^32, if it has one
 * member. */
std::int64_t inflatedSize(InputFile& file)
{
  const std::string_view tail = file.at(file.size() - 4, 4);
  std::uint32_t said = 0;
  std::memcpy(&said, tail.data(), sizeof(said));
  const auto least = static_cast<std::int64_t>(file.size());
  constexpr std::int64_t Modulus = std::int64_t(1) << 32;
  return said + (std::max<std::int64_t>(least - said, 0) + Modulus - 1) / Modulus * Modulus;
}

/** Numbers of vertices and cells have 32 bits during a conversion, see RawMesh. */
constexpr std::int64_t MostNumbers = (std::int64_t(1) << 32) - 2;

/** The counts of a file, from its header or estimated from its size. */
struct Counts : FileCounts
{
  std::int64_t inflatedBytes = 0; ///< of a compressed file
};

Counts guess(InputFile& file, bool compressed, const VertexShare& share)
{
  Counts counts;
  if (compressed && file.size() >= 18)
  {
    counts.inflatedBytes = inflatedSize(file);
  }
  const auto bytes =
    counts.inflatedBytes > 0 ? counts.inflatedBytes : static_cast<std::int64_t>(file.size());
  counts.corners = share.corners;
  counts.vertices = bytes / share.bytes;
  counts.cells = counts.vertices * (share.corners == 3 ? 2 : 6);
  return counts;
}

Counts countsOf(const std::filesystem::path& path, const MeshPart& part)
{
  const MeshFileKind kind = kindOfInput(path);
  if (kind == MeshFileKind::Vsm)
  {
    checkIsWhole(part, path.string());
    const StreamInfo info = VsmReader(path).info();
    return { { info.vertices, info.cells, cornersOf(info.cellType), columnBytes(info), true }, 0 };
  }
  const bool compressedStream = isCompressedStream(path);
  if (kind == MeshFileKind::Unknown && !compressedStream)
  {
    throw Error(path.string() + ": the format is not known by its content or suffix.");
  }
  const Format* const format = kind == MeshFileKind::Stream ? &StreamsFormat : formatOfFile(path);
  InputFile file(path);
  const bool compressed = isGzip(file.at(0, 2));
  if (!format || !format->hasParts)
  {
    checkIsWhole(part, path.string());
  }
  if (format && format->counts && !compressed && !compressedStream)
  {
    if (const std::optional<FileCounts> counts = format->counts(file, part))
    {
      return { *counts, 0 };
    }
  }
  return guess(file, compressed, format ? format->share : VertexShare{});
}

} // namespace

std::filesystem::path scratchPlace(const std::filesystem::path& folder)
{
  std::error_code absent;
  return folder.empty() ? std::filesystem::temp_directory_path(absent) : folder;
}

std::int64_t plainStreamBytes(std::int64_t vertices, std::int64_t corners)
{
  constexpr std::int64_t VertexBytes = 11, CornerBytes = 2;
  return vertices * VertexBytes + corners * CornerBytes;
}

std::int64_t freeBytes(const std::filesystem::path& folder)
{
  std::error_code unknown;
  const std::filesystem::space_info room = std::filesystem::space(scratchPlace(folder), unknown);
  return unknown ? -1 : static_cast<std::int64_t>(room.available);
}

std::int64_t scratchBytes(
  std::int64_t vertices, std::int64_t cells, int corners, std::int64_t columnBytes)
{
  // The parsed mesh, the pages and the cells by their places, the last two of which do not overlap
  // with everything before them; columns twice while they are reordered.
  constexpr std::int64_t VertexBytes = 95;
  constexpr std::int64_t CornerBytes = 15;
  return vertices * VertexBytes + cells * corners * CornerBytes + 2 * columnBytes;
}

std::int64_t scratchBytes(const RawMesh& mesh)
{
  std::int64_t columns = 0;
  for (const RawColumn& column : mesh.vertexColumns)
  {
    columns += mesh.vertices * static_cast<std::int64_t>(column.spec.tupleBytes());
  }
  for (const RawColumn& column : mesh.elementColumns)
  {
    columns += mesh.elementCount * static_cast<std::int64_t>(column.spec.tupleBytes());
  }
  return scratchBytes(mesh.vertices, mesh.cells, cornersOf(mesh.cellType), columns);
}

void checkScratchRoom(const std::filesystem::path& folder, std::int64_t bytes, std::int64_t written)
{
  const std::int64_t room = freeBytes(folder);
  // A mesh that fits into the memory needs half as much as one that does not.
  if (room >= 0 && room < bytes / 2 - written)
  {
    throw Error(scratchPlace(folder).string() + ": the scratch files take about " +
                mebibytes(bytes) + ", there is room for " + mebibytes(room + written) +
                ": choose another folder for them (option --scratch).");
  }
}

ConversionEstimate estimateConversion(
  const std::filesystem::path& in, const ConversionOptions& options)
{
  const Counts counts = countsOf(in, { options.timeStep, options.partition });
  if (counts.counted && std::max(counts.vertices, counts.cells) > MostNumbers)
  {
    throw Error(in.string() + ": the mesh has " + std::to_string(counts.vertices) +
                " vertices and " + std::to_string(counts.cells) + " cells; at most " +
                std::to_string(MostNumbers) + " of each can be converted: split it.");
  }
  ConversionEstimate estimate;
  estimate.vertices = counts.vertices;
  estimate.cells = counts.cells;
  estimate.counted = counts.counted;
  estimate.memory_bytes =
    options.memoryLimit > 0 ? options.memoryLimit : ConversionOptions::DefaultMemory;
  estimate.scratch_bytes =
    scratchBytes(counts.vertices, counts.cells, counts.corners, counts.columnBytes) +
    counts.inflatedBytes;
  estimate.cellType = counts.corners == 4 ? CellType::Tetrahedron : CellType::Triangle;
  estimate.scratch_free = freeBytes(options.scratch);
  constexpr double SecondsOfVertex = 1.0e-6;
  constexpr double SecondsOfCorner = 0.3e-6;
  const auto corners = static_cast<double>(counts.cells * counts.corners);
  const auto vertices = static_cast<double>(counts.vertices);
  estimate.output_bytes =
    plainStreamBytes(counts.vertices, counts.cells * counts.corners) + counts.columnBytes;
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
