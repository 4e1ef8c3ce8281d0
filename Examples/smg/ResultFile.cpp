// SPDX-License-Identifier: BSD-3-Clause
#include "ResultFile.h"

#include "IO/External/Workspace.h"
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
  const bool isFormat = smg::suffixFor(smg::FormatUse::Write, this->Files.out) ||
                        smg::suffixFor(smg::FormatUse::Restore, this->Files.out);
  const smg::FormatUse use = hasColumns ? smg::FormatUse::WriteColumns : smg::FormatUse::Write;
  if (!smg::suffixFor(use, this->Files.out) && !(hasColumns && this->restoresColumns()))
  {
    const std::string why = isFormat && hasColumns
                              ? "this format cannot hold " + this->Files.columns
                              : "this is not a format of a result";
    throw smg::Error(
      this->Files.out.string() + ": " + why + ": write it as " + this->choices() + '.' +
      (this->Files.welds ? " Formats in the order of the input are not possible with --weld."
                         : ""));
  }
  smg::checkOutputPlace(this->Files.out);
}

std::string ResultFile::choices(std::optional<smg::CellType> cells) const
{
  const bool hasColumns = !this->Files.columns.empty();
  std::vector<smg::FormatUse> uses{ hasColumns ? smg::FormatUse::WriteColumns
                                               : smg::FormatUse::Write };
  if (!this->Files.welds && smg::kindOfInput(this->Files.in) == smg::MeshFileKind::Indexed)
  {
    uses.push_back(hasColumns ? smg::FormatUse::RestoreColumns : smg::FormatUse::Restore);
  }
  return smg::suffixList(uses, cells, "or");
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
  const smg::MeshFileKind kind = smg::kindOfInput(this->Files.in);
  // A .vsm file is in stream order, and so is the result where the format can have that.
  const bool isContainer =
    kind == smg::MeshFileKind::Vsm && !smg::suffixFor(smg::FormatUse::Write, this->Files.out);
  return !this->Files.welds && canRestore && (kind == smg::MeshFileKind::Indexed || isContainer);
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
    this->check(smg::FormatUse::Restore, cells);
    return;
  }
  if (!smg::suffixFor(smg::FormatUse::Write, this->Files.out))
  {
    throw smg::Error(this->Files.out.string() + ": " + this->Files.in.string() + " has " +
                     (conversion ? "a column OriginalId of its own" : "no column OriginalId") +
                     ", so that the result can be written in stream order only: choose " +
                     smg::suffixList(smg::FormatUse::Write, cells, "or") + '.');
  }
  this->check(smg::FormatUse::Write, cells);
}

void ResultFile::check(smg::FormatUse use, smg::CellType cells) const
{
  const std::filesystem::path& out = this->Files.out;
  smg::checkHolds(out, *smg::suffixFor(use, out), cells, this->choices(cells));
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
