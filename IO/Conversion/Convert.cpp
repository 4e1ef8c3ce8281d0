// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/Convert.h"

#include "IO/Container/VsmReader.h"
#include "IO/Conversion/AddedColumn.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/Formats/InQuotes.h"
#include "IO/Formats/StreamConversion.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Import/Importer.h"
#include "IO/Order/CellFlagger.h"
#include "IO/Order/LayoutSource.h"
#include "IO/Output/WriteMesh.h"
#include "IO/Output/WriteVsm.h"
#include "Solver/Core/Error.h"
#include "Solver/Storage/ScratchFolder.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>

namespace smg
{

namespace
{

/** Seconds since the last time it was asked. */
class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

const ColumnSpec FlagsSpec{ CellFlagsName, ScalarType::UInt8, 1 };

/** One conversion. */
class Conversion
{
public:
  Conversion(const std::filesystem::path& in, const std::filesystem::path& out,
    const ConversionOptions& options)
    : In(in)
    , Out(out)
    , Options(options)
    , Budget(options.memoryLimit)
    , From(kindOfInput(in))
    , To(kindOfOutput(out))
  {
    requireAvailable(options.order);
    checkOutput(out);
    this->Report.order = nameOf(options.order);
  }

  ConversionReport run()
  {
    const auto start = std::chrono::steady_clock::now();
    const bool isStream = this->From == MeshFileKind::Vsm || this->From == MeshFileKind::Stream;
    if (isStream && this->Options.order == StreamOrder::Keep)
    {
      this->convertStream();
    }
    else
    {
      this->convertMesh();
    }
    this->Report.seconds.total =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return this->Report;
  }

private:
  std::filesystem::path scratch(const char* name)
  {
    if (!this->Scratch)
    {
      this->Scratch.emplace(this->Options.scratch);
    }
    return this->Scratch->path() / name;
  }

  ProgressFunction part(double begin, double end) const
  {
    return partOf(this->Options.progress, begin, end);
  }

  /** Makes a .vsm file of a streaming file; answers its name. */
  std::filesystem::path importStream(double endOfPart)
  {
    StreamToVsmOptions options;
    options.codec = Codec::Lz4;
    options.scratch = this->scratch(".");
    options.memory = std::min<std::int64_t>(this->Budget.limit() / 4, std::int64_t(256) << 20);
    options.progress = this->part(0.0, endOfPart);
    const std::filesystem::path path = this->scratch("stream.vsm");
    this->Report.isolated_vertices = streamToVsm(this->In, path, options).isolatedVertices;
    return path;
  }

  IndexedMesh importInput()
  {
    if (this->From == MeshFileKind::Indexed || this->From == MeshFileKind::Unknown)
    {
      return importMesh(this->In, { this->Budget, this->part(0.0, 0.35) });
    }
    if (this->From == MeshFileKind::Vsm)
    {
      return loadVsm(this->In, this->Budget, this->part(0.0, 0.35));
    }
    return loadVsm(this->importStream(0.25), this->Budget, this->part(0.25, 0.35));
  }

  /**
   * A column that has the name of the original numbers, but is not of their type, as in the formats
   * that have no such integers, is one of the mesh's own: gives it a free name.
   */
  void renameNumbers(std::vector<Column>& columns, const char* name)
  {
    const auto isNamed = [&columns](const std::string& candidate)
    {
      return std::ranges::any_of(
        columns, [&candidate](const Column& column) { return column.spec.name == candidate; });
    };
    for (Column& column : columns)
    {
      if (column.spec.name == name && column.spec != ColumnSpec{ name, ScalarType::Int64, 1 })
      {
        int number = 1;
        while (isNamed(name + ('_' + std::to_string(number))))
        {
          ++number;
        }
        column.spec.name += '_' + std::to_string(number);
        this->Report.notes.push_back("The column " + inQuotes(name) + " of the input is called " +
                                     inQuotes(column.spec.name) + ", since " + inQuotes(name) +
                                     " says the places in the input itself.");
      }
    }
  }

  /** Through memory, into a new order. */
  void convertMesh()
  {
    IndexedMesh mesh = this->importInput();
    checkOutput(this->Out, mesh.cellType);
    this->Report.seconds.import = this->Watch.lap();
    this->renameNumbers(mesh.vertexColumns, OriginalIdName);
    this->renameNumbers(mesh.cellColumns, OriginalCellIdName);
    const StreamLayout layout = layOut(mesh, this->Options.order, this->part(0.35, 0.65));
    this->Report.seconds.order = this->Watch.lap();
    this->Report.isolated_vertices += layout.isolatedVertices;
    this->Report.degenerate_cells = layout.degenerateCells;
    this->Report.duplicate_cells = layout.duplicateCells;
    this->Report.dropped_cells = mesh.droppedCells;
    this->Report.triangulated_polygons = mesh.triangulatedPolygons;
    for (const std::string& name : mesh.droppedColumns)
    {
      this->Report.notes.push_back(
        "The column " + inQuotes(name) + " was left out, since its name is reserved.");
    }
    this->Report.components = layout.components;
    this->Report.boundary_edges = layout.boundaryEdges;
    this->Report.nonmanifold_edges = layout.nonManifoldEdges;
    LayoutSource source(mesh, layout);
    this->write(source, 0.65);
  }

  /** From stream to stream, block by block. */
  void convertStream()
  {
    const std::filesystem::path path =
      this->From == MeshFileKind::Vsm ? this->In : this->importStream(0.4);
    const VsmReader reader(path);
    const StreamInfo& info = reader.info();
    checkOutput(this->Out, info.cellType);
    this->Report.seconds.import = this->Watch.lap();
    const bool flagged = findColumn(info.cellColumns, FlagsSpec) >= 0;
    flagged ? this->countFlags(reader) : this->findFlags(reader);
    this->Report.seconds.order = this->Watch.lap();

    std::unique_ptr<MeshSource> source = reader.source();
    if (!flagged && (this->Report.degenerate_cells > 0 || this->Report.duplicate_cells > 0))
    {
      source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, FlagsSpec,
        [flagger = CellFlagger(info.cellType)](const MeshBlock& block, Column& column) mutable
        { std::memcpy(column.bytes.data(), flagger.flags(block).data(), column.bytes.size()); });
    }
    this->write(*source, 0.6);
  }

  /** Counts the flags that the cells of the stream have. */
  void countFlags(const VsmReader& reader)
  {
    Progress reported(this->part(0.4, 0.6));
    const std::unique_ptr<MeshSource> source = reader.source({}, { CellFlagsName });
    for (MeshBlock block; source->next(block);)
    {
      reported.update(
        static_cast<double>(block.firstCell) / static_cast<double>(reader.info().cells));
      for (const std::uint8_t flags : block.cellColumns[0].as<std::uint8_t>())
      {
        this->Report.degenerate_cells += (flags & DegenerateCell) != 0 ? 1 : 0;
        this->Report.duplicate_cells += (flags & DuplicateCell) != 0 ? 1 : 0;
      }
    }
  }

  /** Counts the degenerate and duplicate cells of the stream, unless that takes too much. */
  void findFlags(const VsmReader& reader)
  {
    const StreamInfo& info = reader.info();
    if (info.span > this->Budget.limit() / CellFlagger::BytesPerVertex)
    {
      this->Report.notes.push_back(
        "The order of the stream is too poor (span " + std::to_string(info.span) +
        ") to look for degenerate and duplicate cells within the memory limit.");
      return;
    }
    Progress reported(this->part(0.4, 0.6));
    CellFlagger flagger(info.cellType);
    const std::unique_ptr<MeshSource> source = reader.source({}, {});
    for (MeshBlock block; source->next(block);)
    {
      flagger.flags(block);
      reported.update(static_cast<double>(block.firstCell) / static_cast<double>(info.cells));
    }
    this->Report.degenerate_cells = flagger.degenerateCells();
    this->Report.duplicate_cells = flagger.duplicateCells();
  }

  /** Writes the stream in the format of the output. */
  void write(MeshSource& source, double begin)
  {
    const bool direct = this->To == MeshFileKind::Vsm;
    const double end = direct ? 1.0 : 0.85;
    const std::filesystem::path path = direct ? this->Out : this->scratch("mesh.vsm");
    const WrittenVsm written = writeVsm(source, path, direct ? this->Options.codec : Codec::Lz4,
      this->part(begin, end), direct ? this->Options.origin : std::string());
    this->Report.vertices = written.info.vertices;
    this->Report.cells = written.info.cells;
    this->Report.width = written.info.width;
    this->Report.span = written.info.span;
    this->Report.mean_width = written.meanWidth;
    if (!direct)
    {
      for (std::string& note : writeFromVsm(path, this->Out, this->part(end, 1.0)))
      {
        this->Report.notes.push_back(std::move(note));
      }
    }
    this->Report.seconds.write = this->Watch.lap();
  }

  const std::filesystem::path& In;
  const std::filesystem::path& Out;
  const ConversionOptions& Options;
  const MemoryBudget Budget;
  const MeshFileKind From, To;
  std::optional<ScratchFolder> Scratch;
  Stopwatch Watch;
  ConversionReport Report;
};

} // namespace

ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
{
  return Conversion(in, out, options).run();
}

} // namespace smg
