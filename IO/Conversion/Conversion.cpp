// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/Conversion.h"

#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/ConversionFields.h"
#include "IO/Conversion/ConversionStages.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Import/Weld.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <string>
#include <utility>

namespace smg
{

namespace
{

/** Memory for buffered vertices while a streaming format is read. */
constexpr std::int64_t MaxStreamMemory = std::int64_t(256) << 20;

} // namespace

Conversion::Conversion(const std::filesystem::path& in, const std::filesystem::path& out,
  const ConversionOptions& options, MeshImporter importer)
  : In(in)
  , Out(out)
  , Options(options)
  , Memory(memoryOf(options))
  , Importer(std::move(importer))
  , From(this->Importer ? MeshFileKind::Indexed : kindOfInput(in))
  , To(kindOfOutput(out))
  , State(this->Importer || this->From == MeshFileKind::Vsm ? InputState() : InputState(in))
{
  this->checkOptions();
}

void Conversion::checkOptions() const
{
  checkLeastMemory(this->In.string() + ": a conversion", this->Memory);
  if (this->Options.scratchLimit < 0)
  {
    throw Error(this->In.string() + ": the limit of scratch files must not be negative.");
  }
  if (this->Options.weld)
  {
    checkWeldDistance(*this->Options.weld);
  }
}

bool Conversion::hasStages(const std::filesystem::path& in, const ConversionOptions& options)
{
  const std::filesystem::path none;
  return !options.restoreOrder && !isCompressedStream(in) &&
         !Conversion(in, none, options).copies();
}

Workspace& Conversion::workspace()
{
  if (!this->Space)
  {
    this->kept();
    this->Space.emplace(this->scratch(), this->Memory, this->Options.progress,
      this->Options.scratchLimit, this->Options.threads);
  }
  return *this->Space;
}

ScratchFolder* Conversion::kept()
{
  if (!this->Kept && !this->Options.checkpoint.empty())
  {
    requireNoConversionIn(this->Options.checkpoint);
    this->Kept.emplace(KeptFolder(this->Options.checkpoint));
  }
  return this->Kept ? &*this->Kept : nullptr;
}

ProgressFunction Conversion::progress()
{
  return [&workspace = this->workspace()](double done)
  {
    workspace.tell(done);
    return true;
  };
}

const VsmReader& Conversion::openStream()
{
  checkIsWhole(this->part(), this->In.string());
  const bool direct = this->From == MeshFileKind::Vsm;
  this->Stream.emplace(direct ? this->In : this->importStream());
  this->Stream->requireBlocksWithin(this->Memory);
  this->checkCells(this->Stream->info());
  if (direct)
  {
    this->Report.isolated_vertices = this->Stream->isolatedVertices();
  }
  return *this->Stream;
}

/** Converts a streaming file to a .vsm file; returns its name. */
std::filesystem::path Conversion::importStream()
{
  StreamToVsmOptions options;
  options.scratch = this->workspace().folder();
  options.memory = std::min<std::int64_t>(this->Memory / 4, MaxStreamMemory);
  options.progress = this->progress();
  const std::filesystem::path path = this->workspace().folder() / "stream.vsm";
  this->Report.isolated_vertices = streamToVsm(this->In, path, options).isolatedVertices;
  this->checkInput();
  return path;
}

/** Throws Error if a stream, whose cells have one type, has none of the requested cells. */
void Conversion::checkCells(const StreamInfo& info) const
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

/** Throws Error if a few rows of the columns, of which a block has at least one cell with its
 * vertices, take all memory. */
void Conversion::checkRows(const StreamInfo& mesh) const
{
  constexpr std::int64_t RowsInUse = 16;
  const std::int64_t bytes = rowBytes(mesh.cellColumns, rowBytes(mesh.vertexColumns));
  if (bytes > this->Memory / RowsInUse)
  {
    throw MemoryError(this->In.string() + ": its columns have " + std::to_string(bytes) +
                      " bytes for a vertex and a cell, which takes " +
                      mebibytes(RowsInUse * bytes) + ", but the memory limit is " +
                      mebibytes(this->Memory) + ": raise it, or leave columns out.");
  }
}

void Conversion::write(MeshSource& source, const AddTables& add)
{
  this->checkRows(source.info());
  const bool direct = this->To == MeshFileKind::Vsm;
  const ProgressFunction progress = this->progress();
  const std::filesystem::path path = direct ? this->Out : this->workspace().folder() / "mesh.vsm";
  // With little memory blocks are compressed one after the other.
  Workspace& space = this->workspace();
  const std::int64_t blockMemory = BlockFileWriter::memoryFor(space.workers());
  const bool parallel = space.available() > 4 * blockMemory;
  const Reservation blocks(space.pool(), parallel ? blockMemory : 0);
  const WrittenVsm written = writeVsm(source, path,
    { .codec = direct ? this->Options.codec : Codec::Lz4,
      .scratch = space.folder(),
      .origin = direct ? this->Options.origin : std::string(),
      .add = add,
      .workers = parallel ? &space.workers() : nullptr,
      .progress = partOf(progress, 0.0, direct ? 1.0 : 0.6) });
  this->Report.vertices = written.info.vertices;
  this->Report.cells = written.info.cells;
  this->Report.width = written.info.width;
  this->Report.span = written.info.span;
  this->Report.mean_width = written.meanWidth;
  if (!direct)
  {
    for (std::string& note :
      writeFromVsm(path, this->Out, partOf(progress, 0.6, 1.0), space.folder(), this->Options.text))
    {
      this->Report.notes.push_back(std::move(note));
    }
  }
  this->Report.seconds.write = this->lap();
}

double Conversion::lap()
{
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - this->Last).count();
  this->Last = now;
  return seconds;
}

std::string ConversionReport::json(int indent) const
{
  return jsonOf<false>(*this).dump(
    indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::vector<std::string> ConversionReport::changes() const
{
  const struct
  {
    std::int64_t count;
    const char *one, *several;
  } counts[] = {
    { this->dropped_cells, "cell of another type is left out.",
      "cells of other types are left out." },
    { this->higher_order_cells, "higher-order cell has its corners alone.",
      "higher-order cells have their corners alone." },
    { this->degenerate_cells, "cell is degenerate, without area or volume.",
      "cells are degenerate, without area or volume." },
    { this->duplicate_cells, "cell has the corners of an earlier one.",
      "cells have the corners of an earlier one." },
  };
  std::vector<std::string> sentences;
  for (const auto& [count, one, several] : counts)
  {
    if (count > 0)
    {
      sentences.push_back(groupedDigits(count) + ' ' + (count == 1 ? one : several));
    }
  }
  return sentences;
}

bool isCompressedStream(const std::filesystem::path& path)
{
  // A text stream looks like an OBJ file: its name decides.
  std::error_code ignored;
  const auto hasCompression = [&path]
  {
    InputFile file(path);
    return isCompressed(file);
  };
  return std::filesystem::is_regular_file(path, ignored) &&
         std::filesystem::file_size(path, ignored) > 0 && hasCompression() &&
         (kindOfInput(path) != MeshFileKind::Indexed || streamFormatOfName(path.stem()));
}

} // namespace smg
