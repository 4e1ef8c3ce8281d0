// SPDX-License-Identifier: BSD-3-Clause
#include "ResultFile.h"

#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/WriteFiles.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <limits>
#include <utility>

ResultFile::ResultFile(Options options)
  : Files(std::move(options))
{
  if (this->mayRestore())
  {
    smg::checkOutputPlace(this->Files.out);
    return;
  }
  const bool hasColumns = !this->Files.columns.empty();
  const bool isFormat = smg::suffixFor(smg::FormatUse::Write, this->Files.out) != nullptr;
  const smg::FormatUse use = hasColumns ? smg::FormatUse::WriteColumns : smg::FormatUse::Write;
  if (!smg::suffixFor(use, this->Files.out) && !(hasColumns && this->restoresColumns()))
  {
    const std::string why = isFormat && hasColumns
                              ? "this format cannot hold " + this->Files.columns
                              : "this is not a format of a result";
    throw smg::Error(
      this->Files.out.string() + ": " + why + ": write it as " + this->choices() + '.');
  }
  smg::checkOutputPlace(this->Files.out);
}

std::string ResultFile::choices(std::optional<smg::CellType> cells) const
{
  const smg::FormatUse use =
    this->Files.columns.empty() ? smg::FormatUse::Write : smg::FormatUse::WriteColumns;
  return smg::suffixList({ &use, 1 }, cells, "or");
}

bool ResultFile::restoresColumns() const
{
  const bool named = !this->Files.changed.empty();
  return named ? smg::restoresColumns(this->Files.out, this->Files.changed)
               : smg::suffixFor(smg::FormatUse::RestoreColumns, this->Files.out) != nullptr;
}

bool ResultFile::mayRestore() const
{
  const bool canRestore = this->Files.columns.empty()
                            ? smg::suffixFor(smg::FormatUse::Restore, this->Files.out) != nullptr
                            : this->restoresColumns();
  if (this->Files.welds || !canRestore)
  {
    return false;
  }
  const smg::MeshFileKind kind = smg::kindOfInput(this->Files.in);
  // A .vsm file is in stream order, and so is the result if it is written as a stream.
  return kind == smg::MeshFileKind::Indexed ||
         (kind == smg::MeshFileKind::Vsm &&
           !smg::formatOfSuffix(smg::lowerSuffix(this->Files.out))->isStreamed());
}

bool ResultFile::mayRewrite() const
{
  // Of merged points only one moves, so that IN cannot be rewritten.
  return this->Files.columns.empty() && !this->Files.welds &&
         smg::canRewrite(this->Files.in, this->Files.out);
}

smg::WrittenOrder ResultFile::expectedOrder(const smg::StreamInfo& mesh) const
{
  const bool isNumbered = smg::findColumn(mesh.vertexColumns, smg::OriginalIdSpec) >= 0;
  return this->mayRewrite()                 ? smg::WrittenOrder::Rewritten
         : this->mayRestore() && isNumbered ? smg::WrittenOrder::Restored
                                            : smg::WrittenOrder::Stream;
}

void ResultFile::chooseOrder(const smg::VsmReader& mesh, const smg::ConversionReport* conversion)
{
  const smg::CellType cells = mesh.info().cellType;
  if (this->mayRewrite())
  {
    this->Order = smg::WrittenOrder::Rewritten;
    smg::checkOutput(this->Files.out, cells);
    return;
  }
  const std::vector<smg::ColumnSpec>& columns = mesh.info().vertexColumns;
  const bool isNumbered = conversion
                            ? !conversion->keeps_numbers
                            : std::ranges::find(columns, smg::OriginalIdSpec) != columns.end();
  if (this->mayRestore() && isNumbered)
  {
    this->Order = smg::WrittenOrder::Restored;
  }
  const std::filesystem::path& out = this->Files.out;
  smg::checkHolds(out, *smg::suffixFor(smg::FormatUse::Write, out), cells, this->choices(cells));
  smg::checkOutputPlace(out);
}

int ResultFile::threads(std::int64_t memory) const
{
  return memory > smg::Workspace::MinMemory ? this->Files.threads : 1;
}

std::vector<std::string> ResultFile::write(const smg::VsmReader& mesh, smg::MeshSource& result,
  std::int64_t memory, const smg::ProgressFunction& progress) const
{
  if (this->Order == smg::WrittenOrder::Rewritten)
  {
    smg::RewriteOptions options;
    options.scratch = this->Files.scratch;
    options.memory = memory;
    options.progress = progress;
    smg::rewriteMesh(this->Files.in, this->Files.out, result, options);
    return {};
  }
  if (this->Order == smg::WrittenOrder::Restored)
  {
    return this->writeRestored(mesh, result, memory, progress);
  }
  smg::WriteMeshOptions options;
  options.scratch = this->Files.scratch;
  options.isolatedFrom = mesh.path();
  options.threads = this->threads(memory);
  options.progress = progress;
  return smg::writeMesh(result, this->Files.out, options);
}

std::vector<std::string> ResultFile::writeRestored(const smg::VsmReader& mesh,
  smg::MeshSource& result, std::int64_t memory, const smg::ProgressFunction& progress) const
{
  smg::Workspace space(
    this->Files.scratch, memory, smg::partOf(progress, 0.4, 1.0), 0, this->threads(memory));
  smg::WriteMeshOptions options;
  options.codec = smg::Codec::Lz4;
  options.isolatedFrom = mesh.path();
  options.threads = this->threads(memory);
  options.progress = smg::partOf(progress, 0.0, 0.4);
  const std::filesystem::path stream = space.folder() / "result.vsm";
  smg::writeMesh(result, stream, options);
  space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
  return smg::writeRestored(stream, this->Files.out, space);
}
