// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/Convert.h"

#include "IO/Container/VsmReader.h"
#include "IO/Conversion/AddedColumn.h"
#include "IO/Conversion/CompressedStream.h"
#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/MeshFile.h"
#include "IO/Conversion/NumberNames.h"
#include "IO/Conversion/PartialProgress.h"
#include "IO/External/Workspace.h"
#include "IO/Formats/InQuotes.h"
#include "IO/Formats/StreamConversion.h"
#include "IO/Formats/StreamFile.h"
#include "IO/Import/Importer.h"
#include "IO/Order/CellFlagger.h"
#include "IO/Order/IsolatedVertices.h"
#include "IO/Order/LayOut.h"
#include "IO/Order/LayoutSource.h"
#include "IO/Output/WriteMesh.h"
#include "IO/Output/WriteVsm.h"
#include "IO/Raw/ReadStream.h"
#include "IO/Raw/Weld.h"
#include "IO/Restore/WriteRestored.h"
#include "Solver/Core/Error.h"
#include "Solver/Core/Timer.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <span>
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

/** Memory that vertices wait in while a streaming format is read. */
constexpr std::int64_t MostStreamMemory = std::int64_t(256) << 20;

/** One conversion. */
class Conversion
{
public:
  Conversion(const std::filesystem::path& in, const std::filesystem::path& out,
    const ConversionOptions& options)
    : In(in)
    , Out(out)
    , Options(options)
    , Memory(options.memoryLimit > 0 ? options.memoryLimit : ConversionOptions::DefaultMemory)
    , From(kindOfInput(in))
    , To(kindOfOutput(out))
  {
    if (this->Memory < Workspace::LeastMemory)
    {
      throw Error("A conversion needs a memory limit of at least " +
                  std::to_string(Workspace::LeastMemory >> 20) + " MiB.");
    }
    if (options.weld)
    {
      checkWeldDistance(*options.weld);
    }
    options.restoreOrder ? this->checkRestored() : checkOutput(out);
    this->Report.order = options.restoreOrder ? "restored" : nameOf(options.order);
  }

  ConversionReport run()
  {
    const Timer timer;
    const double cpu = processSeconds();
    if (this->Options.restoreOrder)
    {
      this->restore();
    }
    else if (this->isStream() && this->Options.order == StreamOrder::Keep && !this->Options.weld)
    {
      this->convertStream();
    }
    else
    {
      this->convertMesh();
    }
    this->noteTraffic();
    this->Report.seconds.total = timer.seconds();
    this->Report.cpu_seconds = processSeconds() - cpu;
    this->Report.rss_bytes_peak = peakResidentBytes();
    return this->Report;
  }

private:
  bool isStream() const
  {
    return this->From == MeshFileKind::Vsm || this->From == MeshFileKind::Stream;
  }

  void checkRestored() const
  {
    if (this->From != MeshFileKind::Vsm)
    {
      throw Error(this->In.string() +
                  ": only a .vsm file knows the order of the file that it was made of: give one.");
    }
  }

  Workspace& workspace()
  {
    if (!this->Space)
    {
      this->Space.emplace(this->Options.scratch, this->Memory, this->Options.progress);
    }
    return *this->Space;
  }

  std::filesystem::path scratch(const char* name) { return this->workspace().folder() / name; }

  /** Progress of the workspace's current part, for what tells fractions. */
  ProgressFunction toldTo(Workspace& workspace)
  {
    return [&workspace](double done)
    {
      workspace.tell(done);
      return true;
    };
  }

  /** Makes a .vsm file of a streaming file; answers its name. */
  std::filesystem::path importStream(const ProgressFunction& progress)
  {
    StreamToVsmOptions options;
    options.codec = Codec::Lz4;
    options.scratch = this->workspace().folder();
    options.memory = std::min<std::int64_t>(this->Memory / 4, MostStreamMemory);
    options.progress = progress;
    const std::filesystem::path path = this->scratch("stream.vsm");
    this->Report.isolated_vertices = streamToVsm(this->In, path, options).isolatedVertices;
    return path;
  }

  /** Throws Error if a stream, whose cells are all of one kind, has none of those that are wanted.
   */
  void checkCells(const StreamInfo& info) const
  {
    const CellChoice unwanted =
      info.cellType == CellType::Triangle ? CellChoice::Tetrahedra : CellChoice::Triangles;
    if (this->Options.cells == unwanted)
    {
      throw Error(this->In.string() + ": the file has no " +
                  (unwanted == CellChoice::Triangles ? "triangles" : "tetrahedra") +
                  " (option --cells).");
    }
  }

  RawMesh importInput(Workspace& space)
  {
    space.beginPart(0.15, std::numeric_limits<std::int64_t>::max());
    if (!this->isStream())
    {
      return importMesh(this->In, space, { this->Options.cells, this->toldTo(space) });
    }
    return readStream(*this->openStream(space).source(), this->In.string(), space);
  }

  /** The stream that is the input, as a .vsm file. */
  const VsmReader& openStream(Workspace& space)
  {
    const bool direct = this->From == MeshFileKind::Vsm;
    this->Stream.emplace(direct ? this->In : this->importStream(this->toldTo(space)));
    this->checkCells(this->Stream->info());
    if (direct)
    {
      this->Report.isolated_vertices = this->Stream->isolatedVertices();
    }
    return *this->Stream;
  }

  /** Refuses what certainly does not fit the disk where the file says how large the mesh is. */
  void checkSaidRoom() const
  {
    if (this->From == MeshFileKind::Unknown)
    {
      return;
    }
    const ConversionEstimate estimate = estimateConversion(this->In, this->Options);
    if (estimate.counted)
    {
      checkScratchRoom(this->Options.scratch, estimate.scratch_bytes);
    }
  }

  /** The same of a mesh that is in scratch files itself. */
  void checkRoom(const RawMesh& mesh, Workspace& space) const
  {
    checkScratchRoom(this->Options.scratch, scratchBytes(mesh), space.traffic().bytesWritten);
  }

  /** By scratch files, into a new order. */
  void convertMesh()
  {
    this->checkSaidRoom();
    Workspace& space = this->workspace();
    RawMesh mesh = this->importInput(space);
    checkOutput(this->Out, mesh.cellType);
    this->checkRoom(mesh, space);
    if (this->Options.weld)
    {
      this->Report.merged_points = weldPoints(mesh, *this->Options.weld, space);
    }
    freeNumberNames(mesh, this->Report.notes);
    this->Report.seconds.import = this->Watch.lap();

    LayOutCounts counts;
    const StreamLayout layout = layOut(mesh, this->Options.order, space, counts, 0.75);
    this->note(mesh.counts, counts.mesh);
    this->Report.pages = counts.pages.pages;
    this->Report.page_loads = counts.pages.loads;
    this->Report.degenerate_cells = layout.degenerateCells;
    this->Report.duplicate_cells = layout.duplicateCells;
    this->Report.inverted_cells =
      mesh.cellType == CellType::Tetrahedron ? layout.invertedCells : -1;
    this->Report.seconds.order = this->Watch.lap();

    space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
    LayoutSource source(mesh, layout, space);
    this->write(source, this->toldTo(space),
      [&](VsmWriter& writer)
      {
        takeIsolatedVertices(mesh, layout, space,
          [&writer](const IsolatedVertices& vertices)
          { writer.isolated(vertices.ids, vertices.positions, vertices.columns); });
        // Those of a stream are beside it already, by their numbers in the first file.
        if (this->Stream)
        {
          copyIsolated(this->Stream->path(), source.info(), writer);
        }
      });
  }

  void note(const ImportCounts& file, const MeshCounts& mesh)
  {
    this->Report.isolated_vertices += mesh.isolatedVertices - this->Report.merged_points;
    this->Report.components = mesh.components;
    this->Report.boundary_edges = mesh.boundaryEdges;
    this->Report.nonmanifold_edges = mesh.nonManifoldEdges;
    this->Report.nonmanifold_vertices = mesh.nonManifoldVertices;
    this->Report.dropped_cells = file.droppedCells;
    this->Report.triangulated_polygons = file.triangulatedPolygons;
    this->Report.split_cells = file.splitCells;
    this->Report.higher_order_cells = file.higherOrderCells;
    this->Report.merged_points = file.mergedPoints;
    for (const std::string& name : file.droppedColumns)
    {
      this->Report.notes.push_back("The column " + inQuotes(name) +
                                   " was left out, since its name is reserved or used twice.");
    }
    this->Report.notes.insert(this->Report.notes.end(), file.notes.begin(), file.notes.end());
  }

  void noteTraffic()
  {
    Workspace& space = this->workspace();
    this->Report.pool_bytes_peak = space.pool().peak();
    this->Report.scratch_bytes_read = space.traffic().bytesRead;
    this->Report.scratch_bytes_written = space.traffic().bytesWritten;
  }

  /** From stream to stream, block by block. */
  void convertStream()
  {
    Workspace& space = this->workspace();
    constexpr std::int64_t Unknown = std::numeric_limits<std::int64_t>::max();
    space.beginPart(0.4, Unknown);
    const VsmReader& reader = this->openStream(space);
    const StreamInfo& info = reader.info();
    checkOutput(this->Out, info.cellType);
    this->Report.seconds.import = this->Watch.lap();
    const bool flagged = findColumn(info.cellColumns, FlagsSpec) >= 0;
    space.beginPart(0.6, Unknown);
    flagged ? this->countFlags(reader) : this->findFlags(reader);
    this->Report.seconds.order = this->Watch.lap();

    std::unique_ptr<MeshSource> source = reader.source();
    if (!flagged && (this->Report.degenerate_cells > 0 || this->Report.duplicate_cells > 0))
    {
      source = std::make_unique<AddedColumn>(std::move(source), AddedColumn::Cells, FlagsSpec,
        [flagger = CellFlagger(info.cellType)](const MeshBlock& block, Column& column) mutable
        { std::memcpy(column.bytes.data(), flagger.flags(block).data(), column.bytes.size()); });
    }
    space.beginPart(1.0, Unknown);
    this->write(*source, this->toldTo(space),
      [&](VsmWriter& writer) { copyIsolated(reader.path(), source->info(), writer); });
  }

  /** Back into the order of the first file. */
  void restore()
  {
    Workspace& space = this->workspace();
    space.beginPart(1.0, std::numeric_limits<std::int64_t>::max());
    const VsmReader reader(this->In);
    checkRestoredPath(this->Out, reader.info().cellType);
    this->Report.vertices = reader.info().vertices;
    this->Report.cells = reader.info().cells;
    this->Report.notes = writeRestored(this->In, this->Out, space);
    this->Report.seconds.write = this->Watch.lap();
  }

  /** Counts the flags that the cells of the stream have. */
  void countFlags(const VsmReader& reader)
  {
    Progress reported(this->toldTo(this->workspace()));
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
    if (info.span > this->Memory / CellFlagger::BytesPerVertex)
    {
      this->Report.degenerate_cells = this->Report.duplicate_cells = -1;
      this->Report.notes.push_back(
        "The order of the stream is too poor (span " + std::to_string(info.span) +
        ") to look for degenerate and duplicate cells within the memory limit.");
      return;
    }
    Progress reported(this->toldTo(this->workspace()));
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

  using AddTables = std::function<void(VsmWriter&)>;

  /** Writes the stream in the format of the output; a .vsm file gets what `add` has to add. */
  void write(MeshSource& source, const ProgressFunction& progress, const AddTables& add)
  {
    const bool direct = this->To == MeshFileKind::Vsm;
    const std::filesystem::path path = direct ? this->Out : this->scratch("mesh.vsm");
    const WrittenVsm written = writeVsm(source, path, direct ? this->Options.codec : Codec::Lz4,
      partOf(progress, 0.0, direct ? 1.0 : 0.6), direct ? this->Options.origin : std::string(),
      add);
    this->Report.vertices = written.info.vertices;
    this->Report.cells = written.info.cells;
    this->Report.width = written.info.width;
    this->Report.span = written.info.span;
    this->Report.mean_width = written.meanWidth;
    if (!direct)
    {
      for (std::string& note : writeFromVsm(path, this->Out, partOf(progress, 0.6, 1.0)))
      {
        this->Report.notes.push_back(std::move(note));
      }
    }
    this->Report.seconds.write = this->Watch.lap();
  }

  const std::filesystem::path& In;
  const std::filesystem::path& Out;
  const ConversionOptions& Options;
  const std::int64_t Memory;
  const MeshFileKind From, To;
  std::optional<Workspace> Space;
  std::optional<VsmReader> Stream; ///< the input, if it is a stream
  Stopwatch Watch;
  ConversionReport Report;
};

} // namespace

ConversionReport convert(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options)
{
  std::error_code absent;
  if (std::filesystem::equivalent(in, out, absent))
  {
    throw Error(out.string() + " is the mesh itself: choose another name for the result.");
  }
  return isCompressedStream(in) ? convertCompressedStream(in, out, options)
                                : Conversion(in, out, options).run();
}

} // namespace smg
