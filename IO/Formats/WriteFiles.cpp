// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/WriteFiles.h"

#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/Workers.h"
#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Streams/RewriteStream.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Results/MovedVertices.h"
#include "Solver/Core/Progress.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace smg
{

void checkRestoredPath(const std::filesystem::path& path, CellType cellType)
{
  const FileSuffix* const suffix = suffixFor(FormatUse::Restore, path);
  if (!suffix)
  {
    throw Error(path.string() + ": the original order can be restored in " +
                suffixList(FormatUse::Restore, "and") +
                " files; a mesh stream has an order of its own.");
  }
  checkHolds(path, *suffix, cellType, suffixList(FormatUse::Restore, cellType, "or"));
}

namespace
{

/** Completes a file. Adds what the format cannot hold of the polygons to the notes of its writer.
 */
WriteNotes finish(MeshFileWriter& writer, const Format& format, const MeshFileInfo& info)
{
  WriteNotes notes = writer.finish();
  if (info.cellType == CellType::Triangle && info.maxCorners > format.maxCorners)
  {
    notes.emplace_back(format.maxCorners == 3
                         ? "Polygons are written as triangles."
                         : "Polygons of more than four corners are written as triangles.");
  }
  return notes;
}

WriteNotes writeInOriginalOrder(
  RestoredMesh& mesh, const Format& format, const std::filesystem::path& path)
{
  const std::unique_ptr<MeshFileWriter> writer =
    format.writer(path, mesh.info(), &mesh.workspace());
  const auto writeVertices = [&]
  {
    for (VertexChunk chunk; mesh.next(chunk);)
    {
      writer->vertices(chunk);
    }
  };
  const auto writeElements = [&]
  {
    do
    {
      mesh.rewindElements();
      for (ElementChunk chunk; mesh.next(chunk);)
      {
        writer->elements(chunk);
      }
    } while (writer->needsElementsAgain());
  };
  if (format.turn == PartTurn::ElementsFirst)
  {
    writeElements();
    writeVertices();
  }
  else
  {
    writeVertices();
    writeElements();
  }
  return finish(*writer, format, mesh.info());
}

/** For PartTurn::Any: as the blocks of the stream come. */
WriteNotes writeInStreamOrder(MeshSource& source, const Format& format,
  const std::filesystem::path& path, const ProgressFunction& progress)
{
  const MeshFileInfo info(source.info());
  const auto corners = static_cast<std::uint32_t>(cornersOf(info.cellType));
  const std::unique_ptr<MeshFileWriter> writer = format.writer(path, info, nullptr);
  Progress reported(progress);
  VertexChunk vertices;
  ElementChunk elements;
  for (MeshBlock block; source.next(block);)
  {
    vertices.first = block.firstVertex;
    std::swap(vertices.positions, block.positions);
    std::swap(vertices.columns, block.vertexColumns);
    writer->vertices(vertices);
    elements.first = block.firstCell;
    std::swap(elements.corners, block.corners);
    std::swap(elements.columns, block.cellColumns);
    elements.sizes.assign(elements.corners.size() / corners, corners);
    writer->elements(elements);
    reported.update(
      static_cast<double>(elements.first + elements.count()) / static_cast<double>(info.cells));
  }
  if (vertices.first + vertices.count() != info.vertices ||
      elements.first + elements.count() != info.cells)
  {
    throw Error(path.string() + ": the mesh stream does not have the " +
                std::to_string(info.vertices) + " vertices and " + std::to_string(info.cells) +
                " cells of its info: write it to a .vsm file first.");
  }
  return finish(*writer, format, info);
}

} // namespace

std::vector<std::string> writeRestored(
  const std::filesystem::path& vsm, const std::filesystem::path& out, Workspace& workspace)
{
  checkRestoredPath(out, VsmReader(vsm).info().cellType);
  RestoredMesh mesh(vsm, workspace);
  std::vector<std::string> notes = mesh.notes();
  const WriteNotes more = writeInOriginalOrder(mesh, *formatOfName(out), out);
  notes.insert(notes.end(), more.begin(), more.end());
  workspace.tell(1.0);
  return notes;
}

std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  checkOutput(path, source.info().cellType);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  if (format.turn == PartTurn::Any)
  {
    return writeInStreamOrder(source, format, path, options.progress);
  }
  Workers workers(options.threads);
  if (format.kind == MeshFileKind::Vsm)
  {
    const auto addIsolated = [&](VsmWriter& writer)
    {
      if (!options.isolatedFrom.empty())
      {
        copyIsolated(options.isolatedFrom, source.info(), writer);
      }
    };
    writeVsm(source, path,
      { .codec = options.codec,
        .scratch = options.scratch,
        .add = addIsolated,
        .workers = &workers,
        .apart = true,
        .progress = options.progress });
    return {};
  }
  const ScratchFolder scratch(options.scratch);
  const std::filesystem::path whole = scratch / "mesh.vsm";
  writeVsm(source, whole,
    { .codec = Codec::Lz4,
      .scratch = scratch.path(),
      .workers = &workers,
      .apart = true,
      .progress = partOf(options.progress, 0.0, 0.6) });
  WriteMeshOptions rest = options;
  rest.scratch = scratch.path();
  rest.progress = partOf(options.progress, 0.6, 1.0);
  return format.writeVsm(whole, path, rest);
}

std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress,
  const std::filesystem::path& scratch)
{
  VsmReader reader(vsm);
  checkOutput(path, reader.info().cellType);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  WriteMeshOptions options;
  options.scratch = scratch;
  options.isolatedFrom = vsm;
  options.progress = progress;
  if (format.writeVsm)
  {
    return format.writeVsm(vsm, path, options);
  }
  return writeMesh(*reader.source(), path, options);
}

namespace
{

bool isPlainPly(const std::filesystem::path& path)
{
  return formatOfFile(path) == &PlyFormat && !isGzip(InputFile(path).at(0, 2));
}

} // namespace

bool canRewrite(const std::filesystem::path& in, const std::filesystem::path& out)
{
  const MeshFileKind from = kindOfInput(in);
  const MeshFileKind to = kindOfOutput(out);
  if (from == MeshFileKind::Stream && to == MeshFileKind::Stream)
  {
    return cellTypeOf(detectStreamFormat(in)) == cellTypeOf(*streamFormatOfName(out));
  }
  return from == MeshFileKind::Indexed && formatOfName(out) == &PlyFormat && isPlainPly(in);
}

void rewriteMesh(const std::filesystem::path& in, const std::filesystem::path& out,
  MeshSource& moved, const RewriteOptions& options)
{
  if (!canRewrite(in, out))
  {
    throw Error(out.string() + ": the order of " + in.string() +
                " can be kept in a file of the same kind only, from a streaming format to a "
                "streaming format for these cells, or from PLY to PLY.");
  }
  Workspace workspace(options.scratch, options.memory);
  MovedVertices vertices(moved, workspace, partOf(options.progress, 0.0, 0.3));
  const ProgressFunction progress = partOf(options.progress, 0.3, 1.0);
  if (formatOfName(out) == &PlyFormat)
  {
    rewritePly(in, out, vertices, progress);
  }
  else
  {
    rewriteStream(in, out, vertices, progress);
  }
}

} // namespace smg
