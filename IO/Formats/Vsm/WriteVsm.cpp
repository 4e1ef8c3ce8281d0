// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/WriteVsm.h"

#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Formats/Vsm/VsmWriter.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Workers.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace smg
{
namespace
{

/** Rounds the coordinates to numbers of single precision. */
void roundToSingle(std::vector<double>& positions)
{
  for (double& x : positions)
  {
    x = static_cast<float>(x);
  }
}

/** Sets all components to a number. */
void fill(Column& column, double value)
{
  dispatch(column.spec.type,
    [&]<class T>(T) { std::ranges::fill(column.as<T>(), static_cast<T>(value)); });
}

constexpr FileSuffix VsmSuffixes[] = { { ".vsm" } };

} // namespace

void forEachIsolated(
  const std::filesystem::path& vsm, const std::string& fingerprint, const CompleteIsolated& use)
{
  VsmReader reader(vsm, nullptr, fingerprint);
  IsolatedVertices chunk;
  const std::int64_t rows = VsmFormat::blockRows(rowBytes(reader.info().vertexColumns));
  for (std::int64_t first = 0; first < reader.isolatedVertices(); first += rows)
  {
    reader.readIsolated(first, std::min(rows, reader.isolatedVertices() - first), chunk);
    use(first, chunk);
  }
}

void copyIsolated(const std::filesystem::path& from, const StreamInfo& info, VsmWriter& writer,
  const CompleteIsolated& complete, const std::string& fingerprint, const CompleteIsolated& change)
{
  forEachIsolated(from, fingerprint,
    [&](std::int64_t first, IsolatedVertices& chunk)
    {
      if (complete)
      {
        complete(first, chunk);
      }
      std::vector<Column> columns = emptyColumns(info.vertexColumns);
      for (Column& column : columns)
      {
        const std::ptrdiff_t same = findColumn(chunk.columns, column.spec);
        column.resize(chunk.ids.size());
        if (column.spec.isolated)
        {
          fill(column, *column.spec.isolated);
        }
        else if (same >= 0)
        {
          column.bytes = chunk.columns[static_cast<std::size_t>(same)].bytes;
        }
      }
      chunk.columns = std::move(columns);
      if (change)
      {
        change(first, chunk);
      }
      if (!info.doublePositions)
      {
        roundToSingle(chunk.positions);
      }
      writer.isolated(chunk.ids, chunk.positions, chunk.columns);
    });
}

WrittenVsm writeVsm(
  MeshSource& source, const std::filesystem::path& path, const WriteVsmOptions& options)
{
  Progress reported(options.progress);
  Workers* const workers = options.workers;
  VsmWriter writer(path, source.info(),
    { .codec = options.codec, .scratch = options.scratch, .workers = workers });
  const auto cells = static_cast<double>(source.info().cells);
  const auto corners = static_cast<std::size_t>(cornersOf(source.info().cellType));
  Workers appending(options.apart && workers ? std::min(2, workers->threads()) : 1);
  OrderedJobs<MeshBlock> appends(
    appending, static_cast<std::size_t>(appending.threads()),
    [&writer](MeshBlock& block) { writer.append(block); },
    [&](MeshBlock& block)
    {
      const auto end = block.firstCell + static_cast<std::int64_t>(block.corners.size() / corners);
      reported.update(static_cast<double>(end) / cells);
    });
  const auto read = [&](MeshBlock& block)
  {
    try
    {
      return source.next(block);
    }
    catch (...)
    {
      appends.takeAll(); // an error of the block before comes first
      throw;
    }
  };
  while (read(appends.next()))
  {
    appends.takeAll();
    appends.submit();
  }
  appends.takeAll();
  if (options.add)
  {
    options.add(writer);
  }
  WrittenVsm written{ writer.finish(options.origin), 0.0 };
  written.meanWidth = writer.meanWidth();
  return written;
}

const Format VsmFileFormat{
  .name = "VSM",
  .suffixes = VsmSuffixes,
  .description = "the container of this project",
  .cells = "triangles, tetrahedra",
  .kind = MeshFileKind::Vsm,
  .holdsColumns = true,
  .bytes = [](const MeshToWrite& written) { return written.vsmBytes; },
};

} // namespace smg
