// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/WriteFiles.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Results/MovedVertices.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Text.h"
#include "Solver/Core/Workers.h"
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

/** Says that a format has no place for the groups of a mesh. */
void noteGroups(const MeshGroups& groups, const Format& format, WriteNotes& notes)
{
  if (!groups.empty() && format.groups == GroupForm::None)
  {
    notes.push_back("The groups of the mesh are left out, since " +
                    std::string(format.suffixes.front().text) + " files have no place for them.");
  }
}

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

/** What of the groups of a .vsm file is not in its cells; null: it has none, or the format has no
 * elements of groups. */
std::shared_ptr<const GroupElements> groupsOf(
  const VsmReader& reader, const Format& format, bool restored, Workspace& space)
{
  const bool areElements =
    format.groups == GroupForm::Elements || format.groups == GroupForm::Sides;
  return reader.info().groups.empty() || !areElements
           ? nullptr
           : std::make_shared<GroupElements>(reader, restored, space);
}

/** Writes vertices and elements apart, in the order in which `mesh` gives them. */
template <class Mesh>
WriteNotes writeParts(Mesh& mesh, const Format& format, const std::filesystem::path& path,
  std::shared_ptr<const GroupElements> groups, Workspace& space, bool text)
{
  MeshFileInfo info = mesh.info();
  info.text = text;
  info.groups = std::move(groups);
  const std::unique_ptr<MeshFileWriter> writer = format.writer(path, info, &space);
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
  if (format.writeOrder == WriteOrder::ElementsFirst)
  {
    writeElements();
    writeVertices();
  }
  else
  {
    writeVertices();
    writeElements();
  }
  return finish(*writer, format, info);
}

void take(MeshBlock& block, VertexChunk& chunk)
{
  chunk.first = block.firstVertex;
  std::swap(chunk.positions, block.positions);
  std::swap(chunk.columns, block.vertexColumns);
}

void take(MeshBlock& block, CellType cells, ElementChunk& chunk)
{
  const auto corners = static_cast<std::uint32_t>(cornersOf(cells));
  chunk.first = block.firstCell;
  std::swap(chunk.corners, block.corners);
  std::swap(chunk.columns, block.cellColumns);
  chunk.sizes.assign(chunk.corners.size() / corners, corners);
}

/** The mesh of a .vsm file in stream order: its vertices and, from another reading, its cells. */
class StreamedMesh
{
public:
  /** `allColumns`: also those that a conversion adds. `groups`: see ownColumns(). */
  StreamedMesh(const std::filesystem::path& vsm, bool allColumns, GroupForm groups,
    const ProgressFunction& progress)
    : Reader(vsm)
    , Info(this->Reader.info())
    , Reported(progress)
  {
    if (!allColumns)
    {
      this->Info.vertexColumns = ownColumns(this->Info.vertexColumns, groups);
      this->Info.elementColumns = ownColumns(this->Info.elementColumns, groups);
    }
    this->Vertices = this->Reader.source(columnNames(this->Info.vertexColumns), {});
  }

  const MeshFileInfo& info() const { return this->Info; }
  const VsmReader& reader() const { return this->Reader; }

  bool next(VertexChunk& chunk)
  {
    const bool more = this->Vertices->next(this->Block);
    if (more)
    {
      take(this->Block, chunk);
      this->tell(chunk.count());
    }
    return more;
  }

  bool next(ElementChunk& chunk)
  {
    const bool more = this->Cells->next(this->Block);
    if (more)
    {
      take(this->Block, this->Info.cellType, chunk);
      this->tell(chunk.count());
    }
    return more;
  }

  void rewindElements()
  {
    this->Cells = this->Reader.source({}, columnNames(this->Info.elementColumns));
  }

private:
  void tell(std::int64_t count)
  {
    this->Delivered += count;
    this->Reported.update(static_cast<double>(this->Delivered) /
                          static_cast<double>(this->Info.vertices + this->Info.elements));
  }

  VsmReader Reader;
  MeshFileInfo Info;
  Progress Reported;
  std::unique_ptr<MeshSource> Vertices, Cells;
  MeshBlock Block;
  std::int64_t Delivered = 0; ///< vertices and elements
};

/** Writes vertices and elements as the blocks of a stream come. */
WriteNotes writeAsTheyCome(MeshSource& source, const Format& format,
  const std::filesystem::path& path, const ProgressFunction& progress)
{
  const MeshFileInfo info(source.info());
  const std::unique_ptr<MeshFileWriter> writer = format.writer(path, info, nullptr);
  Progress reported(progress);
  VertexChunk vertices;
  ElementChunk elements;
  for (MeshBlock block; source.next(block);)
  {
    take(block, vertices);
    writer->vertices(vertices);
    take(block, info.cellType, elements);
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
  WriteNotes notes = finish(*writer, format, info);
  noteGroups(source.info().groups, format, notes);
  return notes;
}

/** Writes a .vsm file in stream order, in a format for which it is read more than once. */
WriteNotes writeAgain(const Format& format, const std::filesystem::path& vsm,
  const std::filesystem::path& path, const WriteMeshOptions& options)
{
  if (format.writeVsm)
  {
    return format.writeVsm(vsm, path, options);
  }
  Workspace space(options.scratch, StreamOrderMemory);
  StreamedMesh mesh(vsm, format.isStreamed(), format.groups, options.progress);
  return writeParts(
    mesh, format, path, groupsOf(mesh.reader(), format, false, space), space, options.text);
}

/** Adds to the notes of a writer that this many vertices of no cell are not written. */
std::vector<std::string> withoutIsolated(
  WriteNotes notes, const Format& format, std::int64_t isolated)
{
  if (isolated > 0)
  {
    notes.push_back(
      counted(
        isolated, "vertex belongs to no cell: it is", "vertices belong to no cell: they are") +
      " left out, since " +
      (format.holdsVertices ? "only .vsm files and formats in the order of the input have"
                            : std::string(format.suffixes.front().text) + " files do not have") +
      " a place for them.");
  }
  return notes;
}

/** The same for those of a .vsm file, if one is given. */
std::vector<std::string> withoutIsolated(
  WriteNotes notes, const Format& format, const WriteMeshOptions& options)
{
  const bool isGiven = !options.isolatedFrom.empty();
  return withoutIsolated(std::move(notes), format,
    isGiven
      ? VsmReader(options.isolatedFrom, nullptr, options.isolatedFingerprint).isolatedVertices()
      : 0);
}

bool isPlainPly(const std::filesystem::path& path)
{
  InputFile file(path);
  return formatOfFile(path) == &PlyFormat && !isCompressed(file);
}

} // namespace

std::vector<std::string> writeRestored(const std::filesystem::path& vsm,
  const std::filesystem::path& out, Workspace& workspace, bool text)
{
  VsmReader reader(vsm, &workspace.traffic());
  checkRestoredPath(out, reader.info().cellType);
  checkForm(out, text);
  const Format& format = *formatOfName(out);
  RestoredMesh mesh(reader, workspace, format.maxCorners, format.groups);
  std::vector<std::string> notes = mesh.notes();
  const WriteNotes more =
    writeParts(mesh, format, out, groupsOf(reader, format, true, workspace), workspace, text);
  notes.insert(notes.end(), more.begin(), more.end());
  noteGroups(reader.info().groups, format, notes);
  return withoutIsolated(
    std::move(notes), format, format.holdsVertices ? 0 : reader.isolatedVertices());
}

std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options)
{
  checkOutput(path, source.info().cellType);
  checkForm(path, options.text);
  checkIsNotInput(options.isolatedFrom, path);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  if (format.writeOrderOf(options.text) == WriteOrder::Interleaved)
  {
    return withoutIsolated(
      writeAsTheyCome(source, format, path, options.progress), format, options);
  }
  Workers workers(options.threads);
  if (format.kind == MeshFileKind::Vsm)
  {
    const auto addIsolated = [&](VsmWriter& writer)
    {
      if (!options.isolatedFrom.empty())
      {
        copyIsolated(options.isolatedFrom, source.info(), writer, options.completeIsolated,
          options.isolatedFingerprint, options.changeIsolated);
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
  WriteNotes notes = writeAgain(format, whole, path, rest);
  noteGroups(source.info().groups, format, notes);
  return withoutIsolated(std::move(notes), format, options);
}

std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress,
  const std::filesystem::path& scratch, bool text)
{
  checkIsNotInput(vsm, path);
  VsmReader reader(vsm);
  checkOutput(path, reader.info().cellType);
  checkForm(path, text);
  const Format& format = *formatOfSuffix(lowerSuffix(path));
  WriteMeshOptions options;
  options.text = text;
  options.scratch = scratch;
  options.isolatedFrom = vsm;
  options.isolatedFingerprint = reader.fingerprint();
  options.progress = progress;
  if (format.kind == MeshFileKind::Vsm || format.writeOrderOf(text) == WriteOrder::Interleaved)
  {
    return writeMesh(*reader.source(), path, options);
  }
  WriteNotes notes = writeAgain(format, vsm, path, options);
  noteGroups(reader.info().groups, format, notes);
  return withoutIsolated(std::move(notes), format, options);
}

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
    rewritePly(in, out, vertices, options, progress);
  }
  else
  {
    rewriteStream(in, out, vertices, progress, options.beforeEnd);
  }
}

} // namespace smg
