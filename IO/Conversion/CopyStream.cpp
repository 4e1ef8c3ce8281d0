// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/CopyStream.h"

#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Order/Assembly/CellFlagger.h"
#include "Solver/Core/Progress.h"
#include "Solver/Mesh/AddedColumn.h"

#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

const ColumnSpec FlagsSpec{ CellFlagsName, ScalarType::UInt8, 1 };

/** Passes all blocks of the stream with these cell columns to `use`, and reports progress. */
template <class Use>
void forEachBlock(Conversion& conversion, const VsmReader& reader,
  const std::vector<std::string>& columns, Use&& use)
{
  Progress reported(conversion.progress());
  const std::unique_ptr<MeshSource> source = reader.source({}, columns);
  for (MeshBlock block; source->next(block);)
  {
    use(block);
    reported.update(
      static_cast<double>(block.firstCell) / static_cast<double>(reader.info().cells));
  }
}

/** Counts the flags of the cells of the stream. */
void countFlags(Conversion& conversion, const VsmReader& reader)
{
  ConversionReport& report = conversion.report();
  forEachBlock(conversion, reader, { CellFlagsName },
    [&report](const MeshBlock& block)
    {
      for (const std::uint8_t flags : block.cellColumns[0].as<std::uint8_t>())
      {
        report.degenerate_cells += (flags & DegenerateCell) != 0 ? 1 : 0;
        report.duplicate_cells += (flags & DuplicateCell) != 0 ? 1 : 0;
      }
    });
}

/** Counts the degenerate and duplicate cells of the stream, unless that needs too much memory. */
void findFlags(Conversion& conversion, const VsmReader& reader)
{
  const StreamInfo& info = reader.info();
  ConversionReport& report = conversion.report();
  if (info.span > conversion.memory() / CellFlagger::BytesPerVertex)
  {
    report.degenerate_cells = report.duplicate_cells = -1;
    report.notes.push_back("The order of the stream is too poor (span " +
                           std::to_string(info.span) +
                           ") to look for degenerate and duplicate cells within the memory limit.");
    return;
  }
  CellFlagger flagger(info.cellType);
  forEachBlock(
    conversion, reader, {}, [&flagger](const MeshBlock& block) { flagger.flags(block); });
  report.degenerate_cells = flagger.degenerateCells();
  report.duplicate_cells = flagger.duplicateCells();
}

std::unique_ptr<MeshSource> withFlags(std::unique_ptr<MeshSource> source, CellType cellType)
{
  return std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, FlagsSpec,
    [flagger = CellFlagger(cellType)](const MeshBlock& block, Column& column) mutable
    { std::memcpy(column.bytes.data(), flagger.flags(block).data(), column.bytes.size()); });
}

} // namespace

void copyStream(Conversion& conversion)
{
  Workspace& space = conversion.workspace();
  ConversionReport& report = conversion.report();
  constexpr std::int64_t Unknown = std::numeric_limits<std::int64_t>::max();
  space.beginPart(0.4, Unknown);
  const VsmReader& reader = conversion.openStream();
  checkOutput(conversion.out(), reader.info().cellType);
  report.seconds.import = conversion.lap();

  const bool flagged = findColumn(reader.info().cellColumns, FlagsSpec) >= 0;
  space.beginPart(0.6, Unknown);
  flagged ? countFlags(conversion, reader) : findFlags(conversion, reader);
  report.seconds.order = conversion.lap();

  std::unique_ptr<MeshSource> source = reader.source();
  if (!flagged && (report.degenerate_cells > 0 || report.duplicate_cells > 0))
  {
    source = withFlags(std::move(source), reader.info().cellType);
  }
  space.beginPart(1.0, Unknown);
  conversion.write(
    *source, [&](VsmWriter& writer) { copyIsolated(reader.path(), source->info(), writer); });
}

} // namespace smg
