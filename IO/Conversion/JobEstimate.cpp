// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/JobEstimate.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/ConversionFields.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/ExternalSort.h"
#include "IO/Files/FileNames.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "IO/Formats/WriteFiles.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"
#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include <algorithm>
#include <sys/stat.h>

namespace smg
{
namespace
{

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

/** A format and the suffix of a file; without a format none. */
struct NamedFormat
{
  explicit NamedFormat(const std::filesystem::path& file)
    : text(lowerSuffix(file))
    , format(formatOfSuffix(this->text))
  {
    if (this->format)
    {
      this->suffix =
        *std::ranges::find(this->format->suffixes, std::string_view(this->text), &FileSuffix::text);
    }
  }

  /** Whether the bytes depend on the numbers in the file, and can be far fewer than estimated. */
  bool dependsOnNumbers() const
  {
    return !this->format || this->format->kind == MeshFileKind::Vsm ||
           this->suffix.form == FileForm::Text;
  }

  std::string text;
  const Format* format;
  FileSuffix suffix{};
};

void replace(int table, const ColumnSpec& added, std::vector<ColumnSpec>& columns, VsmParts& parts)
{
  std::erase_if(columns, [&added](const ColumnSpec& column) { return column.name == added.name; });
  columns.push_back(added);
  parts.erase({ table, added.name });
}

/** A mesh with its result: what it has, and its size as a .vsm file. */
struct ResultMesh
{
  ResultMesh(const EstimatedInput& in, const AddedValues& added)
    : mesh(in.info)
    , parts(in.parts)
  {
    for (const ColumnSpec& column : added.ofVertices)
    {
      replace(VsmFormat::Vertices, column, this->mesh.vertexColumns, this->parts);
    }
    for (const ColumnSpec& column : added.ofCells)
    {
      replace(VsmFormat::Cells, column, this->mesh.cellColumns, this->parts);
    }
    if (added.movesVertices)
    {
      this->parts.erase({ VsmFormat::Vertices, "Position" });
    }
  }

  /** The mesh is to have another order, which numbers of vertices and cells depend on. */
  void forgetNumbers()
  {
    this->parts.erase({ VsmFormat::Vertices, OriginalIdName });
    this->parts.erase({ VsmFormat::Cells, OriginalCellIdName });
    this->parts.erase({ VsmFormat::Last, "LastCell" });
    this->parts.erase({ VsmFormat::Cells, "Corners" });
  }

  std::int64_t bytes(Codec codec) const { return vsmBytes(this->mesh, codec, this->parts); }

  /** The mesh without the columns that a file in the order of its original does not have. */
  StreamInfo restored() const
  {
    StreamInfo own = this->mesh;
    own.vertexColumns = ownColumns(own.vertexColumns);
    own.cellColumns = ownColumns(own.cellColumns);
    return own;
  }

  StreamInfo mesh;
  VsmParts parts;
};

/** Bytes of a file of the result; of a .vsm file where its format is not known. */
std::int64_t fileBytes(const ResultMesh& result, const std::filesystem::path& out,
  WrittenOrder order, bool text, Codec codec = Codec::Zstd)
{
  const NamedFormat named(out);
  const std::int64_t vsm = result.bytes(codec);
  const bool isRestored =
    order == WrittenOrder::Restored || (named.format && !named.format->isStreamed());
  return named.format && named.format->bytes
           ? named.format->bytes(
               { isRestored ? result.restored() : result.mesh, vsm, named.suffix, text })
           : vsm;
}

/** The scratch files of the writer of a file of this suffix. */
std::int64_t writerBytes(
  const StreamInfo& mesh, std::int64_t memory, std::string_view suffix, bool text)
{
  const Format* const format = formatOfSuffix(suffix);
  return format && format->scratch ? format->scratch(mesh, memory, text) : 0;
}

/** About the most bytes of scratch files at once while RestoredMesh sorts the mesh of a .vsm file
 * in a workspace of `memory` bytes, and a file of this suffix is written of it. `mesh` has the
 * columns of that file. */
std::int64_t restoreBytes(
  const StreamInfo& mesh, std::int64_t memory, std::string_view suffix, bool text)
{
  constexpr std::int64_t Number = sizeof(std::uint32_t);
  const std::int64_t corners = mesh.cells * cornersOf(mesh.cellType);
  const std::int64_t element =
    rowBytes(mesh.cellColumns, cornersOf(mesh.cellType) * Number); // with the columns
  // As RestoredMesh: vertices and elements are sorted; the stream's corners and the pairs of
  // numbers give way to the elements with their sizes.
  const std::int64_t sorted =
    rowSortBytes(mesh.vertices, rowBytes(mesh.vertexColumns, positionBytes(mesh)), memory / 4) +
    rowSortBytes(mesh.cells, element, memory / 3);
  const std::int64_t numbers = mesh.vertices * 2 * Number + corners * Number;
  const std::int64_t elements = mesh.cells * (Number + element);
  return sorted + std::max(numbers, elements + writerBytes(mesh, memory, suffix, text));
}

/** The most scratch files at once while the result is written. */
std::int64_t writingBytes(const ResultMesh& result, const EstimatedResult& written)
{
  constexpr std::int64_t NormalBytes = 3 * sizeof(float);
  const bool hasNormals = std::ranges::any_of(result.mesh.vertexColumns, isNormals);
  const std::int64_t normals =
    written.added.movesVertices && hasNormals ? result.mesh.vertices * NormalBytes : 0;
  const std::string suffix = lowerSuffix(written.out);
  switch (written.order)
  {
    case WrittenOrder::Restored:
      return normals + result.bytes(Codec::Lz4) +
             restoreBytes(result.restored(), written.memory, suffix, written.text);
    case WrittenOrder::Rewritten:
    {
      // As MovedVertices: a number, the position and the normal of each, sorted by numbers.
      constexpr std::int64_t RowBytes = 4 * sizeof(double);
      const std::int64_t rows = result.mesh.vertices * (RowBytes + (hasNormals ? RowBytes - 8 : 0));
      return normals + rows + (rows * 5 / 4 > written.memory * 3 / 4 ? rows : 0);
    }
    case WrittenOrder::Stream:
      break;
  }
  const Format* const format = formatOfSuffix(suffix);
  const bool readsAgain = format && (format->writeVsm || !format->isStreamed() ||
                                      format->writeOrderOf(written.text) != format->writeOrder);
  return normals + (readsAgain ? result.bytes(Codec::Lz4) : 0) +
         writerBytes(result.mesh, StreamOrderMemory, suffix, written.text);
}

} // namespace

AddedValues solvedValues(const ProblemDescription& problem)
{
  const int columns = problem.columns;
  AddedValues added{ { { SolutionName, ScalarType::Float64, columns } }, {} };
  if (problem.vertexGradientOutput)
  {
    added.ofVertices.push_back({ GradientName, ScalarType::Float64, 3 * columns });
  }
  if (problem.gradientOutput)
  {
    added.ofCells.push_back({ GradientName, ScalarType::Float64, 3 * columns });
  }
  if (problem.fluxOutput)
  {
    added.ofCells.push_back({ FluxName, ScalarType::Float64, 3 * columns });
  }
  return added;
}

EstimatedInput::EstimatedInput(const std::filesystem::path& in, const ConversionOptions& options)
{
  const MeshFileKind kind = kindOfInput(in);
  if (kind == MeshFileKind::Vsm)
  {
    checkIsWhole({ options.timeStep, options.partition }, in.string());
    const VsmFile file(in, nullptr);
    this->counted = true;
    this->info = file.Info;
    this->parts = vsmParts(file);
    this->streamBytes = static_cast<std::int64_t>(std::filesystem::file_size(in));
    return;
  }
  ConversionOptions opening = options;
  opening.order = kind == MeshFileKind::Stream ? StreamOrder::Keep : options.order;
  opening.codec = Codec::Lz4;
  *this = EstimatedInput(estimateConversion(in, opening, true));
}

EstimatedInput::EstimatedInput(const StreamInfo& mesh, const ConversionOptions& options)
{
  ConversionOptions opening = options;
  opening.codec = Codec::Lz4;
  *this = EstimatedInput(estimateConversion(mesh, opening));
}

EstimatedInput::EstimatedInput(const ConversionEstimate& conversion)
  : info(conversion.mesh)
  , counted(conversion.counted)
  , streamBytes(conversion.output_bytes)
  , converts(true)
  , conversionScratch(conversion.scratch_bytes)
  , conversionSeconds(conversion.cpu_seconds)
{
}

JobEstimate::JobEstimate(const EstimatedInput& in, const EstimatedResult& result,
  const Costs& costs, const ConversionOptions& options)
  : vertices(in.info.vertices)
  , cells(in.info.cells)
  , counted(in.counted)
  , memory_bytes(costs.memory)
  , scratch_free(freeBytes(options.scratch))
  , output_free(freeBytes(folderOf(result.out)))
  , passes(costs.passes)
{
  const ResultMesh mesh(in, result.added);
  this->output_bytes =
    result.out.empty() ? 0 : fileBytes(mesh, result.out, result.order, result.text);
  const std::int64_t stream = in.converts ? in.streamBytes : 0;
  this->scratch_bytes = std::max(in.conversionScratch,
    stream +
      std::max(costs.scratch, costs.kept + (result.out.empty() ? 0 : writingBytes(mesh, result))));
  constexpr double SecondsOfByte = 40e-9; // compressed
  this->cpu_seconds =
    in.conversionSeconds + costs.seconds + SecondsOfByte * static_cast<double>(this->output_bytes);
}

JobEstimate::JobEstimate(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
  : scratch_free(freeBytes(options.scratch))
  , output_free(freeBytes(folderOf(out)))
{
  const WrittenOrder order = options.restoreOrder ? WrittenOrder::Restored : WrittenOrder::Stream;
  const bool throughVsm = kindOfOutput(out) != MeshFileKind::Vsm && !options.restoreOrder;
  const ConversionEstimate estimate = estimateConversion(in, options, throughVsm);
  ResultMesh result(EstimatedInput(in, options), {});
  // Most .vsm files are in breadth-first order already.
  if (options.order == StreamOrder::Axis || options.order == StreamOrder::Spectral)
  {
    result.forgetNumbers();
  }
  this->vertices = estimate.vertices;
  this->cells = estimate.cells;
  this->counted = estimate.counted;
  this->memory_bytes = this->memory_limit = estimate.memory_bytes;
  this->output_bytes = fileBytes(result, out, order, options.text, options.codec);
  this->scratch_bytes =
    options.restoreOrder
      ? restoreBytes(result.restored(), estimate.memory_bytes, lowerSuffix(out), options.text)
      : estimate.scratch_bytes;
  this->cpu_seconds = estimate.cpu_seconds;
}

void JobEstimate::checkRoom(const std::filesystem::path& out,
  const std::filesystem::path& scratchFolder, std::int64_t written) const
{
  checkScratchRoom(scratchFolder, this->scratch_bytes, written);
  const bool isOneDisk = onOneDisk(folderOf(out), scratchFolder);
  const std::int64_t scratch = isOneDisk ? this->scratch_bytes : 0;
  const std::int64_t bytes = this->output_bytes + scratch;
  const std::int64_t certain = certainBytes(scratch) + (NamedFormat(out).dependsOnNumbers()
                                                           ? this->output_bytes / 2
                                                           : certainBytes(this->output_bytes));
  if (this->output_free >= 0 && this->output_free < certain - (isOneDisk ? written : 0))
  {
    throw Error(out.string() + ": the result" +
                (isOneDisk ? " and the scratch files take" : " takes") + " about " +
                mebibytes(bytes) + ", there is room for " + mebibytes(this->output_free) +
                ": free space, or choose another folder.");
  }
}

std::string JobEstimate::json(int indent) const
{
  return jsonOf<false>(*this).dump(indent);
}

} // namespace smg
