// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/ResultFile.h"

#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Formats/WriteFiles.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace smg
{

ResultFile::ResultFile(const MeshJob& job, Options options)
  : ResultFile(
      [&]
      {
        options.columns = job.resultColumns();
        options.changed = job.changedColumns();
        options.adds = options.adds || job.turnsCells();
        return std::move(options);
      }())
{
}

ResultFile::ResultFile(Options options)
  : Files(std::move(options))
{
  if (!this->Files.state && !this->Files.in.empty())
  {
    this->Files.state.emplace(this->Files.in);
  }
  checkForm(this->Files.out, this->Files.text);
  if (this->mayRestore())
  {
    checkOutputPlace(this->Files.out);
    return;
  }
  const bool hasColumns = !this->Files.columns.empty();
  const bool isFormat = suffixFor(FormatUse::Write, this->Files.out) != nullptr;
  const FormatUse use = hasColumns ? FormatUse::WriteColumns : FormatUse::Write;
  if (!suffixFor(use, this->Files.out) && !(hasColumns && this->restoresColumns()))
  {
    const std::string why = isFormat && hasColumns
                              ? "this format cannot hold " + this->Files.columns
                              : "this is not a format of a result";
    throw Error(this->Files.out.string() + ": " + why + ": write it as " + this->choices() + '.');
  }
  checkOutputPlace(this->Files.out);
}

std::string ResultFile::choices(std::optional<CellType> cells) const
{
  const FormatUse use = this->Files.columns.empty() ? FormatUse::Write : FormatUse::WriteColumns;
  return suffixList({ &use, 1 }, cells, "or");
}

bool ResultFile::restoresColumns() const
{
  const bool named = !this->Files.changed.empty();
  return named ? smg::restoresColumns(this->Files.out, this->Files.changed)
               : suffixFor(FormatUse::RestoreColumns, this->Files.out) != nullptr;
}

bool ResultFile::mayRestore() const
{
  const bool canRestore = this->Files.columns.empty()
                            ? suffixFor(FormatUse::Restore, this->Files.out) != nullptr
                            : this->restoresColumns();
  if (this->Files.welds || !canRestore)
  {
    return false;
  }
  const MeshFileKind kind = this->kindOfMesh();
  // A .vsm file is in stream order, and so is the result if it is written as a stream.
  return kind == MeshFileKind::Indexed ||
         (kind == MeshFileKind::Vsm && !formatOfSuffix(lowerSuffix(this->Files.out))->isStreamed());
}

MeshFileKind ResultFile::kindOfMesh() const
{
  return this->Files.in.empty() ? MeshFileKind::Indexed : kindOfInput(this->Files.in);
}

bool ResultFile::mayRewrite() const
{
  // Of merged points only one moves, so that IN cannot be rewritten.
  return this->Files.columns.empty() && !this->Files.welds && !this->Files.adds &&
         !this->Files.in.empty() && canRewrite(this->Files.in, this->Files.out);
}

namespace
{

/** The blocks that are looked at. */
enum class Looks
{
  Few, ///< spread evenly over the file
  All
};

/** Whether vertices have original numbers that are places in a file of as many points. Those of a
 * simplified mesh, or of a part, are places in a larger one, which cannot be restored. Throws
 * Cancelled. */
bool numbersArePlaces(VsmReader& reader, Looks looks, const ProgressFunction& progress)
{
  if (findColumn(reader.info().vertexColumns, OriginalIdSpec) < 0)
  {
    return false;
  }
  const std::int64_t vertices = reader.info().vertices;
  const std::int64_t count = vertices + reader.isolatedVertices();
  constexpr std::int64_t Rows = VsmFormat::BlockRows, FewBlocks = 8;
  const std::int64_t blocks = (vertices + Rows - 1) / Rows;
  const std::int64_t step = looks == Looks::All ? 1 : std::max<std::int64_t>(blocks / FewBlocks, 1);
  Column numbers;
  // From the last one on, where a number that is no place is likelier.
  for (std::int64_t block = blocks - 1; block >= 0; block -= step)
  {
    const std::int64_t first = block * Rows;
    reader.readVertexColumn(OriginalIdName, first, std::min(Rows, vertices - first), numbers);
    if (std::ranges::any_of(
          numbers.as<std::int64_t>(), [count](std::int64_t number) { return number >= count; }))
    {
      return false;
    }
    if (progress && !progress(1.0 - static_cast<double>(block) / static_cast<double>(blocks)))
    {
      throw Cancelled();
    }
  }
  return true;
}

} // namespace

WrittenOrder ResultFile::orderIf(const std::function<bool()>& arePlaces) const
{
  return this->mayRewrite()                  ? WrittenOrder::Rewritten
         : this->mayRestore() && arePlaces() ? WrittenOrder::Restored
                                             : WrittenOrder::Stream;
}

WrittenOrder ResultFile::expectedOrder(const StreamInfo& mesh) const
{
  return this->orderIf(
    [&]
    {
      if (this->kindOfMesh() != MeshFileKind::Vsm)
      {
        return findColumn(mesh.vertexColumns, OriginalIdSpec) >= 0;
      }
      VsmReader reader(this->Files.in);
      return numbersArePlaces(reader, Looks::Few, {});
    });
}

void ResultFile::chooseOrder(
  const StoredMesh& mesh, const ConversionReport* conversion, const ProgressFunction& progress)
{
  this->Order = this->orderIf(
    [&]
    {
      if (conversion)
      {
        return !conversion->keeps_numbers;
      }
      VsmReader reader(mesh.file(), nullptr, mesh.fileFingerprint());
      return numbersArePlaces(reader, Looks::All, progress);
    });
  const std::filesystem::path& out = this->Files.out;
  const CellType cells = mesh.info().cellType;
  if (this->Order == WrittenOrder::Rewritten)
  {
    checkOutput(out, cells);
    return;
  }
  checkHolds(out, *suffixFor(FormatUse::Write, out), cells, this->choices(cells));
  checkOutputPlace(out);
}

int ResultFile::threads(std::int64_t memory) const
{
  return memory > Workspace::MinMemory ? this->Files.threads : 1;
}

std::vector<std::string> ResultFile::write(const StoredMesh& mesh, MeshSource& result,
  std::int64_t memory, const ProgressFunction& progress) const
{
  if (this->Order == WrittenOrder::Rewritten)
  {
    RewriteOptions options;
    options.scratch = this->Files.scratch;
    options.memory = memory;
    options.text = this->Files.text;
    options.progress = progress;
    options.beforeEnd = [this] { this->Files.state->check(); };
    rewriteMesh(this->Files.in, this->Files.out, result, options);
    return {};
  }
  if (this->Order == WrittenOrder::Restored)
  {
    return this->writeRestored(mesh, result, memory, progress);
  }
  WriteMeshOptions options;
  options.scratch = this->Files.scratch;
  options.isolatedFrom = mesh.file();
  options.isolatedFingerprint = mesh.fileFingerprint();
  options.completeIsolated = this->Files.isolated;
  options.changeIsolated = this->Files.merged;
  options.threads = this->threads(memory);
  options.text = this->Files.text;
  options.progress = progress;
  return writeMesh(result, this->Files.out, options);
}

std::vector<std::string> ResultFile::writeRestored(const StoredMesh& mesh, MeshSource& result,
  std::int64_t memory, const ProgressFunction& progress) const
{
  Workspace space(
    this->Files.scratch, memory, partOf(progress, 0.4, 1.0), 0, this->threads(memory));
  WriteMeshOptions options;
  options.codec = Codec::Lz4;
  options.isolatedFrom = mesh.file();
  options.isolatedFingerprint = mesh.fileFingerprint();
  options.completeIsolated = this->Files.isolated;
  options.threads = this->threads(memory);
  options.progress = partOf(progress, 0.0, 0.4);
  const std::filesystem::path stream = space.folder() / "result.vsm";
  smg::writeMesh(result, stream, options);
  space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
  return smg::writeRestored(stream, this->Files.out, space, this->Files.text);
}

std::vector<std::string> ResultFile::notesOn(
  const ConversionReport& conversion, const MeshJob& job) const
{
  const bool ordered = this->keepsOrder();
  const Format* const format = formatOfSuffix(lowerSuffix(this->Files.out));
  const bool hasVertices = !format || format->holdsVertices;
  const bool whole = (ordered && hasVertices) || kindOfOutput(this->Files.out) == MeshFileKind::Vsm;
  std::vector<std::string> notes;
  // That they are left out, write() says.
  if (const std::int64_t isolated = conversion.isolated_vertices; isolated > 0 && whole)
  {
    notes.push_back(
      std::to_string(isolated) +
      (isolated == 1 ? " vertex belongs to no cell: it " : " vertices belong to no cell: they ") +
      job.fateOfIsolated(isolated, ordered));
  }
  if (!this->rewritesInput())
  {
    notes.insert(notes.end(), conversion.notes.begin(), conversion.notes.end());
  }
  if (!ordered && this->kindOfMesh() == MeshFileKind::Indexed)
  {
    const Format& format = *formatOfSuffix(lowerSuffix(this->Files.out));
    const bool hasIds = format.holdsColumns && format.isStreamed() && !conversion.keeps_numbers;
    notes.push_back(hasIds
                      ? std::string("The vertices are in stream order; ") + OriginalIdName +
                          " names their places in " +
                          (this->Files.in.empty() ? "the arrays" : this->Files.in.string()) + '.'
                      : "The vertices are in stream order.");
  }
  return notes;
}

} // namespace smg
