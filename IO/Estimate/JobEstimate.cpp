// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Estimate/JobEstimate.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/AnyFormat/MeshFile.h"
#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Files/Suffix.h"
#include "Solver/Core/ByteText.h"
#include "Solver/Storage/FileDescriptor.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <nlohmann/json.hpp>

#include <sys/stat.h>

#include <algorithm>

namespace smg
{
namespace
{

/** Bytes of the columns of a .vsm file, from those of the file. */
std::int64_t columnBytes(const EstimatedInput& in)
{
  return std::max<std::int64_t>(0, in.streamBytes - plainStreamBytes(in.info.vertices,
                                                      in.info.cells * cornersOf(in.info.cellType)));
}

std::filesystem::path folderOf(const std::filesystem::path& file)
{
  const std::filesystem::path folder = FileDescriptor::targetOf(file).parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

/** Whether two folders are in one file system. */
bool onOneDisk(const std::filesystem::path& a, const std::filesystem::path& b)
{
  struct stat first = {}, second = {};
  return ::stat(a.c_str(), &first) == 0 && ::stat(scratchPlace(b).c_str(), &second) == 0 &&
         first.st_dev == second.st_dev;
}

/** Bytes of a file with the mesh and numbers of 8 bytes. */
std::int64_t resultBytes(
  const EstimatedInput& in, const std::filesystem::path& out, std::int64_t numbers)
{
  const std::int64_t corners = in.info.cells * cornersOf(in.info.cellType);
  const std::int64_t values = 8 * numbers;
  const std::string suffix = lowerSuffix(out);
  const Format* const format = formatOfSuffix(suffix);
  if (format && format->kind == MeshFileKind::Vsm)
  {
    return in.streamBytes + values;
  }
  const bool isBinary =
    format &&
    !std::ranges::find(format->suffixes, std::string_view(suffix), &FileSuffix::text)->isText;
  constexpr std::int64_t PointBytes = 18, CornerBytes = 5, TextPointBytes = 34, TextCornerBytes = 7;
  return in.info.vertices * (isBinary ? PointBytes : TextPointBytes) +
         corners * (isBinary ? CornerBytes : TextCornerBytes) + columnBytes(in) + values;
}

} // namespace

EstimatedInput::EstimatedInput(const std::filesystem::path& in, const ConversionOptions& options)
{
  const ConversionEstimate estimate = estimateConversion(in, options);
  this->counted = estimate.counted;
  if (kindOfInput(in) == MeshFileKind::Vsm)
  {
    const VsmReader reader(in);
    this->info = reader.info();
    this->streamBytes = reader.storedBytes();
    return;
  }
  this->info.vertices = estimate.vertices;
  this->info.cells = estimate.cells;
  this->info.cellType = estimate.cellType;
  this->info.span = usualSpan(estimate.cellType, estimate.vertices);
  this->streamBytes = estimate.output_bytes;
  this->conversionScratch = estimate.scratch_bytes;
  this->conversionSeconds = estimate.cpu_seconds;
}

JobEstimate::JobEstimate(const EstimatedInput& in, const std::filesystem::path& out,
  const Costs& costs, const AddedValues& added, const ConversionOptions& options)
  : vertices(in.info.vertices)
  , cells(in.info.cells)
  , counted(in.counted)
  , memory_bytes(costs.memory)
  , scratch_free(freeBytes(options.scratch))
  , output_free(freeBytes(folderOf(out)))
  , passes(costs.passes)
{
  const std::int64_t numbers = in.info.vertices * added.ofVertices + in.info.cells * added.ofCells;
  this->output_bytes = resultBytes(in, out, numbers);
  const bool converts = in.conversionScratch > 0;
  const std::int64_t converted = converts ? in.streamBytes : 0;
  // A file in the order of IN is restored from another stream, while the solution is kept.
  const std::int64_t restored = converts ? converted + in.streamBytes + 3 * 8 * numbers : 0;
  this->scratch_bytes = std::max({ in.conversionScratch, converted + costs.scratch, restored });
  constexpr double SecondsOfByte = 40e-9; // compressed
  this->cpu_seconds =
    in.conversionSeconds + costs.seconds + SecondsOfByte * static_cast<double>(this->output_bytes);
}

void JobEstimate::checkRoom(const std::filesystem::path& out,
  const std::filesystem::path& scratchFolder, std::int64_t written) const
{
  checkScratchRoom(scratchFolder, this->scratch_bytes, written);
  const bool isOneDisk = onOneDisk(folderOf(out), scratchFolder);
  const std::int64_t bytes = this->output_bytes + (isOneDisk ? this->scratch_bytes : 0);
  if (this->output_free >= 0 && this->output_free < bytes / 2 - (isOneDisk ? written : 0))
  {
    throw Error(out.string() + ": the result" +
                (isOneDisk ? " and the scratch files take" : " takes") + " about " +
                mebibytes(bytes) + ", there is room for " + mebibytes(this->output_free) +
                ": free space, or choose another folder.");
  }
}

std::string JobEstimate::json(int indent) const
{
  nlohmann::ordered_json json;
  json["vertices"] = this->vertices;
  json["cells"] = this->cells;
  json["counted"] = this->counted;
  json["memory_bytes"] = this->memory_bytes;
  json["memory_limit"] = this->memory_limit;
  json["scratch_bytes"] = this->scratch_bytes;
  json["scratch_free"] = this->scratch_free;
  json["output_bytes"] = this->output_bytes;
  json["output_free"] = this->output_free;
  json["passes"] = this->passes;
  json["cpu_seconds"] = this->cpu_seconds;
  return json.dump(indent);
}

} // namespace smg
