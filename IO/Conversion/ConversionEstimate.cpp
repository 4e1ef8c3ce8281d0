// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/ConversionEstimate.h"

#include "IO/Conversion/Conversion.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmBytes.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace smg
{

namespace
{

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
constexpr std::int64_t MaxNumbers = (std::int64_t(1) << 32) - 2;

/** The counts of a file, from its header or estimated from its size. */
struct Counts : FileCounts
{
  std::int64_t inflatedBytes = 0; ///< of a compressed file
};

Counts guess(InputFile& file, bool compressed, const TypicalBytes& typical)
{
  Counts counts;
  StreamInfo& mesh = counts.mesh;
  if (compressed && file.size() >= 18)
  {
    counts.inflatedBytes = inflatedSize(file);
  }
  const auto bytes =
    counts.inflatedBytes > 0 ? counts.inflatedBytes : static_cast<std::int64_t>(file.size());
  mesh.cellType = static_cast<CellType>(typical.corners);
  mesh.vertices = bytes / typical.bytes;
  mesh.cells = mesh.vertices * (typical.corners == 3 ? 2 : 6);
  return counts;
}

Counts countsOf(const std::filesystem::path& path, const MeshPart& part)
{
  const MeshFileKind kind = kindOfInput(path);
  if (kind == MeshFileKind::Vsm)
  {
    checkIsWhole(part, path.string());
    return { { VsmReader(path).info(), true }, 0 };
  }
  const bool compressedStream = isCompressedStream(path);
  if (kind == MeshFileKind::Unknown && !compressedStream)
  {
    throw Error(path.string() + ": the format is not known by its content or suffix.");
  }
  const Format* const format = kind == MeshFileKind::Stream ? &StreamsFormat : formatOfFile(path);
  InputFile file(path);
  const bool compressed = isCompressed(file);
  if (kind == MeshFileKind::Indexed)
  {
    const std::string_view start = file.at(0, FormatBytes).substr(0, FormatBytes);
    compressed ? refuseForeignMesh(file.name(), inflateStart(start, FormatBytes), {}, format)
               : refuseForeignMesh(file.name(), start, file.size(), format);
  }
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
  return guess(file, compressed, format ? format->typicalBytes : TypicalBytes{});
}

/** A mesh with the columns that a conversion adds; width and span are the usual ones. */
StreamInfo converted(StreamInfo mesh)
{
  const auto add = [](std::vector<ColumnSpec>& columns, const ColumnSpec& numbers)
  {
    if (findColumn(columns, numbers) < 0)
    {
      columns.push_back(numbers);
    }
  };
  add(mesh.vertexColumns, OriginalIdSpec);
  add(mesh.cellColumns, OriginalCellIdSpec);
  constexpr double WidthOfSpan = 0.85;
  mesh.span = usualSpan(mesh.cellType, mesh.vertices);
  mesh.width = std::llround(WidthOfSpan * static_cast<double>(mesh.span));
  return mesh;
}

/** What does not depend on the file of a mesh. */
ConversionEstimate estimateParsed(const StreamInfo& mesh, const ConversionOptions& options)
{
  ConversionEstimate estimate;
  estimate.mesh = converted(mesh);
  estimate.vertices = mesh.vertices;
  estimate.cells = mesh.cells;
  estimate.memory_bytes = memoryOf(options);
  estimate.output_bytes = vsmBytes(estimate.mesh, options.codec);
  estimate.scratch_free = freeBytes(options.scratch);
  constexpr double SecondsOfVertex = 1.0e-6;
  constexpr double SecondsOfCorner = 0.3e-6;
  const auto corners = static_cast<double>(mesh.cells * cornersOf(mesh.cellType));
  estimate.cpu_seconds =
    static_cast<double>(mesh.vertices) * SecondsOfVertex + corners * SecondsOfCorner;
  return estimate;
}

} // namespace

std::filesystem::path scratchPlace(const std::filesystem::path& folder)
{
  std::error_code absent;
  return folder.empty() ? std::filesystem::temp_directory_path(absent) : folder;
}

std::int64_t freeBytes(const std::filesystem::path& folder)
{
  std::error_code unknown;
  const std::filesystem::space_info room = std::filesystem::space(scratchPlace(folder), unknown);
  return unknown ? -1 : static_cast<std::int64_t>(room.available);
}

std::int64_t scratchBytes(
  const StreamInfo& mesh, const ConversionOptions& options, std::int64_t written)
{
  constexpr std::int64_t Number = sizeof(std::uint32_t);
  const std::int64_t corners = cornersOf(mesh.cellType);
  // The parsed mesh, its vertices in the new order, and the stream.
  const std::int64_t raw =
    mesh.vertices * positionBytes(mesh) + mesh.cells * corners * Number + columnBytes(mesh);
  const std::int64_t ordered = mesh.vertices * (positionBytes(mesh) + 2 * Number);
  const std::int64_t layout = ordered + mesh.cells * (corners + 1) * Number;
  const std::int64_t cellSort = mesh.cells * (corners + 2) * Number;
  // See StreamAssembly.cpp: the cells are sorted in two fifths of the memory or on the disk; in the
  // order of the file they are there with new corners.
  const std::int64_t sorted = options.order == StreamOrder::Keep     ? mesh.cells * corners * Number
                              : cellSort > memoryOf(options) * 2 / 5 ? cellSort
                                                                     : 0;
  // Afterwards columns are there twice, with a number of each row, and perhaps the result.
  const std::int64_t rows =
    (mesh.vertexColumns.empty() ? 0 : mesh.vertices) + (mesh.cellColumns.empty() ? 0 : mesh.cells);
  const std::int64_t joined = columnBytes(mesh) + rows * Number;
  return raw + layout + std::max(ordered + sorted, joined + written);
}

void checkScratchRoom(const std::filesystem::path& folder, std::int64_t bytes, std::int64_t written)
{
  const std::int64_t room = freeBytes(folder);
  if (room >= 0 && room < certainBytes(bytes) - written)
  {
    throw Error(scratchPlace(folder).string() + ": the scratch files take about " +
                mebibytes(bytes) + ", there is room for " + mebibytes(room + written) +
                ": choose another folder for them (option --scratch).");
  }
}

std::optional<StreamInfo> statedMesh(
  const std::filesystem::path& path, const ConversionOptions& options)
{
  const MeshFileKind kind = kindOfInput(path);
  const Format* const format = kind == MeshFileKind::Stream    ? &StreamsFormat
                               : kind == MeshFileKind::Indexed ? formatOfFile(path)
                                                               : nullptr;
  if (!format)
  {
    return {};
  }
  const MeshPart part{ options.timeStep, options.partition };
  const bool isSurface = std::ranges::none_of(format->suffixes, &FileSuffix::tetrahedra);
  if (kind == MeshFileKind::Indexed && !isSurface)
  {
    Workspace space(options.scratch, memoryOf(options), options.progress, options.scratchLimit, 1);
    return converted(lookAtMesh(path, space, { options.cells, options.progress, part }));
  }
  const Counts counts = countsOf(path, part);
  if (!counts.counted && !isSurface)
  {
    return {};
  }
  StreamInfo mesh = counts.counted ? counts.mesh : StreamInfo{};
  mesh.cellType = isSurface ? CellType::Triangle : mesh.cellType;
  return converted(mesh);
}

ConversionEstimate estimateConversion(
  const std::filesystem::path& in, const ConversionOptions& options, bool throughVsm)
{
  const Counts counts = countsOf(in, { options.timeStep, options.partition });
  const StreamInfo& mesh = counts.mesh;
  if (counts.counted && std::max(mesh.vertices, mesh.cells) > MaxNumbers)
  {
    throw Error(in.string() + ": the mesh has " + std::to_string(mesh.vertices) + " vertices and " +
                std::to_string(mesh.cells) + " cells; at most " + std::to_string(MaxNumbers) +
                " of each can be converted: split it.");
  }
  const MeshFileKind kind = kindOfInput(in);
  const bool isStream = kind == MeshFileKind::Stream;
  ConversionEstimate estimate = estimateParsed(mesh, options);
  estimate.counted = counts.counted;
  // Streams are read through a .vsm file, and their order is kept by copying that.
  const std::int64_t stream = vsmBytes(estimate.mesh, Codec::Lz4);
  const std::int64_t written = throughVsm ? stream : 0;
  const bool copies =
    options.order == StreamOrder::Keep && !options.weld && (isStream || kind == MeshFileKind::Vsm);
  const StreamInfo& parsed = isStream ? estimate.mesh : mesh;
  estimate.scratch_bytes = (copies ? written : scratchBytes(parsed, options, written)) +
                           (isStream ? stream : 0) + counts.inflatedBytes;
  return estimate;
}

ConversionEstimate estimateConversion(const StreamInfo& mesh, const ConversionOptions& options)
{
  ConversionEstimate estimate = estimateParsed(mesh, options);
  estimate.counted = true;
  estimate.scratch_bytes = scratchBytes(mesh, options, estimate.output_bytes);
  return estimate;
}

} // namespace smg
