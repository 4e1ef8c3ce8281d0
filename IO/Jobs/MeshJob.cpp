// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/MeshJob.h"

#include "IO/External/Workspace.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/ReadOptions.h"

#include <algorithm>
#include <iterator>

namespace smg
{

std::int64_t MeshJob::writerMemory(std::int64_t memoryLimit)
{
  constexpr std::int64_t MaxMemory = std::int64_t(64) << 20;
  return std::clamp(memoryLimit / 4, Workspace::MinMemory, MaxMemory);
}

void MeshJob::checkOn(const StreamInfo& info) const
{
  this->solutionColumns(info);
  const auto has = [](const std::vector<ColumnSpec>& columns, const std::string& name)
  { return std::ranges::find(columns, name, &ColumnSpec::name) != columns.end(); };
  for (const std::string& name : columnsOf(*this))
  {
    if (!has(info.vertexColumns, name) && !has(info.cellColumns, name))
    {
      throw Error('\'' + name + "': the mesh has no column of this name.");
    }
  }
}

StreamInfo MeshJob::resultOn(const StreamInfo& info) const
{
  StreamInfo result = info;
  const AddedValues added = this->addedTo(info);
  const auto change = [&](std::vector<ColumnSpec>& columns, const std::vector<ColumnSpec>& others)
  {
    std::erase_if(columns,
      [&](const ColumnSpec& column)
      {
        return !this->keeps(column, info) ||
               std::ranges::find(others, column.name, &ColumnSpec::name) != others.end();
      });
    columns.insert(columns.end(), others.begin(), others.end());
  };
  change(result.vertexColumns, added.ofVertices);
  change(result.cellColumns, added.ofCells);
  return result;
}

std::string MeshJob::meshWith(const std::string& columns)
{
  return "The mesh with " + columns + ": " + suffixList(FormatUse::WriteColumns, "or") +
         " in stream order; of a mesh file IN, " + suffixList(FormatUse::RestoreColumns, "and") +
         " in the order of IN, unless that has a column OriginalId or points are welded";
}

AddedValues MeshJob::replacedIn(const StreamInfo& info, const std::vector<std::string>& columns)
{
  AddedValues added;
  std::ranges::copy_if(info.vertexColumns, std::back_inserter(added.ofVertices),
    [&columns](const ColumnSpec& column)
    { return std::ranges::find(columns, column.name) != columns.end(); });
  return added;
}

void SolvingJob::setLimits(const JobLimits& limits)
{
  SolveOptions& own = this->options();
  own.memoryLimit = limits.memory > 0 ? limits.memory : own.memoryLimit;
  own.threads = limits.threads;
  own.scratch = limits.scratch;
  own.scratchLimit = limits.scratchLimit;
}

void SolvingJob::complete(const StoredMesh& mesh, const ProgressFunction& progress)
{
  SolveOptions& own = this->options();
  own.progress = progress;
  if (!own.checkpoint.folder.empty())
  {
    own.checkpoint.mesh = mesh.fingerprint();
    own.checkpoint.problem = this->text;
  }
}

} // namespace smg
