// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzzing/MeshChecks.h"

#include "IO/External/Workspace.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "Testing/Fuzzing/Finding.h"
#include "Testing/Support/RawMeshReading.h"
#include "smg/Convert.h"
#include "smg/Describe.h"
#include "smg/Error.h"
#include "smg/Simplify.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{

namespace
{

bool isFinite(double value)
{
  return std::isfinite(value);
}

void checkColumns(const std::vector<RawColumn>& columns, std::int64_t rows)
{
  for (const RawColumn& column : columns)
  {
    mustHold(column.spec.components > 0, "a column has no components");
    mustHold(!column.spec.name.empty(), "a column has no name");
    mustHold(column.tuples.bytes() == rows * static_cast<std::int64_t>(column.spec.tupleBytes()),
      "a column has not a tuple for each row");
  }
}

void checkColumns(
  const std::vector<Column>& columns, const std::vector<ColumnSpec>& specs, std::size_t rows)
{
  mustHold(columns.size() == specs.size(), "a column is missing");
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    mustHold(columns[c].spec == specs[c], "a column is not what the header says");
    mustHold(columns[c].tuples() == rows, "a column has not a tuple for each row");
  }
}

/** The corners of the stream, in order. */
std::vector<std::int64_t> checkSource(MeshSource& source)
{
  const StreamInfo& info = source.info();
  const int corners = cornersOf(info.cellType);
  std::vector<std::int64_t> all;
  std::int64_t vertices = 0;
  for (MeshBlock block; source.next(block);)
  {
    mustHold(block.firstVertex == vertices, "the vertices of the blocks do not follow");
    mustHold(block.firstCell * corners == std::int64_t(all.size()), "the cells do not follow");
    mustHold(block.vertices() > 0 || !block.corners.empty(), "a block is empty");
    mustHold(std::ranges::all_of(block.positions, isFinite), "a position is not finite");
    std::int64_t next = vertices;
    for (const std::int64_t corner : block.corners)
    {
      mustHold(corner >= 0 && corner <= next, "the stream is not compact");
      next += corner == next ? 1 : 0;
    }
    vertices += block.vertices();
    mustHold(next == vertices, "a vertex of the block has no cell");
    mustHold(block.finalized <= vertices, "a vertex is final that has not come");
    all.insert(all.end(), block.corners.begin(), block.corners.end());
    checkColumns(
      block.vertexColumns, info.vertexColumns, static_cast<std::size_t>(block.vertices()));
    checkColumns(block.cellColumns, info.cellColumns, block.corners.size() / std::size_t(corners));
  }
  mustHold(vertices == info.vertices, "the stream has not the vertices of its header");
  mustHold(std::int64_t(all.size()) == corners * info.cells, "the stream has not its cells");
  return all;
}

void checkPieces(VsmReader& reader, std::span<const std::int64_t> corners)
{
  constexpr std::int64_t pieces = 3;
  const std::int64_t cells = reader.info().cells;
  MeshPiece piece;
  for (std::int64_t p = 0; p < pieces; ++p)
  {
    reader.readPiece(cells * p / pieces, cells * (p + 1) / pieces, piece);
    for (const std::int64_t place : piece.corners)
    {
      mustHold(place >= 0 && place < piece.vertices(), "a corner is not a vertex of the piece");
      mustHold(piece.ids[std::size_t(place)] == corners.front(), "the piece has other corners");
      corners = corners.subspan(1);
    }
    mustHold(std::ranges::all_of(piece.positions, isFinite), "a position is not finite");
  }
  mustHold(corners.empty(), "the pieces have not all cells");
}

/** Reads pieces from the last to the first, each without what is remembered of the one before. */
void checkPiecesBackwards(VsmReader& reader)
{
  const std::vector<ColumnSpec>& columns = reader.info().vertexColumns;
  std::vector<std::string> some;
  for (std::size_t c = columns.size(); c > 1; --c)
  {
    some.push_back(columns[c - 1].name);
  }
  reader.selectColumns(some, {});
  MeshPiece piece;
  for (std::int64_t end = reader.info().cells; end > 0; end -= end / 2 + 1)
  {
    reader.readPiece(end / 2, end, piece);
    mustHold(piece.vertexColumns.size() == some.size(), "a column is missing");
  }
}

void checkVertexColumns(VsmReader& reader)
{
  const std::int64_t vertices = reader.info().vertices;
  for (const ColumnSpec& spec : reader.info().vertexColumns)
  {
    Column column;
    reader.readVertexColumn(spec.name, vertices / 2, vertices - vertices / 2, column);
    checkColumns({ column }, { spec }, static_cast<std::size_t>(vertices - vertices / 2));
  }
}

} // namespace

void checkMesh(const RawMesh& mesh)
{
  mustHold(mesh.vertices > 0 && mesh.cells > 0, "a mesh without vertices or cells is accepted");
  const auto positionBytes = static_cast<std::int64_t>(mesh.positionBytes());
  mustHold(mesh.positions.bytes() == mesh.vertices * positionBytes, "positions are missing");
  checkColumns(mesh.vertexColumns, mesh.vertices);
  checkColumns(mesh.elementColumns, mesh.elementCount);
  const ReadMesh read = readRaw(mesh);
  mustHold(std::ranges::all_of(read.positions, isFinite), "a position is not finite");
  mustHold(mesh.corners.size() == mesh.cells * cornersOf(mesh.cellType), "corners are missing");
  mustHold(std::ranges::all_of(read.corners,
             [&](std::int64_t corner) { return corner >= 0 && corner < mesh.vertices; }),
    "a corner is no vertex");
  mustHold(std::int64_t(read.elements.size()) == mesh.cells, "a cell has no element");
  mustHold(std::ranges::all_of(
             read.elements, [&](std::int64_t element) { return element < mesh.elementCount; }),
    "a cell is of no element");
}

void checkStreamFile(const std::filesystem::path& path)
{
  const std::unique_ptr<StreamFileReader> reader = openStreamFile(path);
  const StreamFileHeader& header = reader->header();
  const auto corners = static_cast<std::size_t>(cornersOf(cellTypeOf(header.format)));
  std::int64_t vertices = 0, cells = 0;
  StreamEvent event;
  for (reader->next(event); event.kind != StreamEvent::End; reader->next(event))
  {
    const auto isVertex = [&](std::int64_t corner)
    { return corner >= 0 && (header.postOrder || corner < vertices); };
    if (event.kind == StreamEvent::Vertex)
    {
      ++vertices;
      mustHold(std::ranges::all_of(event.position, isFinite), "a position is not finite");
      mustHold(event.floats.size() == std::size_t(header.vertexFloats), "a float is missing");
      mustHold(event.ints.size() == std::size_t(header.vertexInts), "an integer is missing");
    }
    else if (event.kind == StreamEvent::Cell)
    {
      ++cells;
      mustHold(std::ranges::all_of(std::span(event.corners).first(corners), isVertex),
        "a corner is no vertex that has come");
      mustHold(event.finalMask < 1U << corners, "there are not as many corners");
    }
    else
    {
      mustHold(isVertex(event.corners[0]), "a vertex is final that has not come");
    }
  }
  mustHold(header.vertices < 0 || header.vertices == vertices, "there are other vertices");
  mustHold(header.cells < 0 || header.cells == cells, "there are other cells");
}

void checkVsm(const std::filesystem::path& path)
{
  VsmReader reader(path);
  const std::vector<std::int64_t> corners = checkSource(*reader.source());
  checkPieces(reader, corners);
  checkPiecesBackwards(reader);
  checkVertexColumns(reader);
  std::vector<std::int64_t> lastCells(static_cast<std::size_t>(reader.info().vertices));
  reader.readLastCells(0, lastCells);
  IsolatedVertices isolated;
  reader.readIsolated(0, reader.isolatedVertices(), isolated);
  mustHold(std::int64_t(isolated.ids.size()) == reader.isolatedVertices(), "one is missing");
  const bool isWhole = !reader.fingerprint().empty() && smg::checkVsm(path) > 0;
  mustHold(isWhole, "the file has no blocks");
}

void checkConversions(const std::filesystem::path& path, const std::filesystem::path& folder)
{
  ConversionOptions options;
  options.memoryLimit = Workspace::MinMemory;
  options.threads = 1;
  options.scratch = folder;
  const std::unique_ptr<OpenedMesh> mesh = openMesh(path, options);
  mustHold(!meshInfo(*mesh).empty(), "there is no information");
  const auto ofFile = [&path](auto compute)
  {
    try
    {
      compute();
    }
    catch (const Error& error)
    {
      // Errors on a mesh do not know its file: its caller names it.
      throw Error(path.string() + ": " + error.what() + '.');
    }
  };
  ofFile([&] { describe(*mesh, { Workspace::MinMemory, {} }); });
  const bool isSurface = mesh->info().cellType == CellType::Triangle;
  for (const StreamOrder order : { StreamOrder::BreadthFirst, StreamOrder::Keep })
  {
    options.order = order;
    const std::filesystem::path out = folder / (order == StreamOrder::Keep ? "out.vtu" : "out.vsm");
    convert(path, out, options);
    std::filesystem::remove(out);
  }
  if (isSurface)
  {
    const std::filesystem::path out = folder / "out.ply";
    SimplifyOptions simplification;
    simplification.memoryLimit = Workspace::MinMemory;
    simplification.threads = 1;
    simplification.scratch = folder;
    ofFile([&] { simplify(*mesh, { .vertices = 10 }, out, simplification); });
    std::filesystem::remove(out);
  }
}

} // namespace smg::testing
