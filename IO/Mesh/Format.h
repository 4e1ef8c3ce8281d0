// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/WriteMesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The part to read of a file with several time steps or partitions; both from 0. */
struct MeshPart
{
  std::int64_t timeStep = 0; ///< a mesh without time steps is step 0
  /** Of the time step; none: all partitions, joined. */
  std::optional<std::int64_t> partition;
};

/** For files without time steps and partitions: throws Error, which begins with the name of the
 * file, if `part` requests one. */
void checkIsWhole(const MeshPart& part, const std::string& name);

class InputFile;
class MeshFileWriter;
struct MeshFileInfo;
class RawMeshBuilder;
class Workspace;

/** How a file holds its mesh. */
enum class MeshFileKind
{
  Vsm,     ///< the container of this library
  Stream,  ///< cells and vertices in the order of a stream
  Indexed, ///< vertices and cells that name them by their numbers, in any order
  Unknown  ///< none of these
};

/** How the numbers of a mesh are written. */
enum class FileForm
{
  Binary,
  Text,
  Either ///< as text on request
};

/** A suffix of the files of a format, and the cells written with it. */
struct FileSuffix
{
  std::string_view text; ///< in lower case, with the dot
  bool triangles = true, tetrahedra = true;
  FileForm form = FileForm::Binary;

  bool holds(CellType cells) const
  {
    return cells == CellType::Triangle ? this->triangles : this->tetrahedra;
  }
};

/** The size of a mesh according to its file, or estimated from the size of the file. */
struct FileCounts
{
  StreamInfo mesh;      ///< counts, precision and columns
  bool counted = false; ///< whether the file states them
};

/** A mesh that is to be written, for an estimate of the bytes of its file. */
struct MeshToWrite
{
  StreamInfo mesh;           ///< with the columns of the result
  std::int64_t vsmBytes = 0; ///< as a .vsm file
  FileSuffix suffix = {};    ///< of the file
  bool text = false;         ///< requested for a suffix with either form
};

/** Bytes of a vertex in a file, with its share of cells: two triangles, six tetrahedra. */
struct TypicalBytes
{
  std::int64_t bytes = 75;
  int corners = 3;
};

/** A sentence for each difference between a written file and the mesh. */
using WriteNotes = std::vector<std::string>;

/** How the files of a format have groups. */
enum class GroupForm : std::uint8_t
{
  None,
  Elements, ///< of facets and vertices, as elements or lists of their own; MeshFileInfo::groups
  Sides,    ///< the same, but facets are sides of elements (IO/Export/GroupSides.h)
  Columns   ///< as columns, of which a table tells; MeshFileInfo::groupTable
};

/** The order in which the writer of a format takes the parts of a mesh. */
enum class WriteOrder
{
  Interleaved, ///< as in a mesh stream, since each vertex and element has its place in the file
  VerticesFirst,
  ElementsFirst
};

/**
 * Begins a mesh file; see IO/Export/MeshFileWriter.h. The file is renamed when it is complete.
 * @param space for scratch files; may be null for WriteOrder::Interleaved
 */
using MeshFileFunction = std::unique_ptr<MeshFileWriter>(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* space);

/** The number of bytes at the beginning of a file that identify its format. */
inline constexpr std::size_t FormatBytes = 4096;

/**
 * The description of a file format: all code that reads, writes and lists formats uses only the
 * table of these (IO/Formats/FormatTable.h). Each format has its own folder; unsupported
 * operations are null.
 */
struct Format
{
  std::string_view name;
  std::span<const FileSuffix> suffixes;
  /** Versions and forms, and the cells of its files, for the table of docs/formats.md. */
  std::string_view description, cells;
  MeshFileKind kind = MeshFileKind::Indexed;

  /** Whether its files have vertices of their own, and so a place for those of no cell. Otherwise
   * they have only the corners of cells. */
  bool holdsVertices = true;
  bool holdsColumns = false; ///< every column of a mesh
  GroupForm groups = GroupForm::None;
  /** Columns of vertices that its files have places for, of a format without all columns. */
  std::span<const std::string_view> vertexColumns = {};
  /** Whether VTK reads its files, too: ParaView opens those itself that fit into memory. */
  bool isReadByVtk = false;

  /** Whether the first bytes of a file have the signature of this format. */
  bool (*hasMagic)(std::string_view start) = nullptr;
  /** Whether all of its files have that signature. */
  bool alwaysHasMagic = false;
  /** The first character of all of its files, of a format whose signature may come after a long
   * comment; 0: none. */
  char firstCharacter = '\0';
  /**
   * Whether the first bytes look like it, for a format without a signature.
   * @param size of the file, if it is known
   */
  bool (*looksLike)(std::string_view start, std::optional<std::uint64_t> size) = nullptr;

  /**
   * Parses a file as a stream and passes the mesh to the builder. Converts a MeshError of the
   * builder to an Error with the position in the file, or leaves it to the caller. For a builder
   * that only looks (RawMeshBuilder::Look), of a format that may hold solids, it skips vertices.
   */
  void (*parse)(InputFile& file, RawMeshBuilder& builder, const MeshPart& part,
    const ProgressFunction& progress) = nullptr;
  /** The size stated at the beginning of an uncompressed file; none if it is too short. */
  std::optional<FileCounts> (*counts)(InputFile& file, const MeshPart& part) = nullptr;
  /** Whether its files have time steps and partitions. Otherwise `part` is the whole mesh. */
  bool hasParts = false;
  /** The times of the time steps of a file; empty: it has none. Null: no file of the format has. */
  std::vector<double> (*times)(const std::filesystem::path& path) = nullptr;
  /** Otherwise, the estimate from the size of the file. */
  TypicalBytes typicalBytes = {};

  /** About the bytes of a file that is written, or of both files of TetGen. */
  std::int64_t (*bytes)(const MeshToWrite& written) = nullptr;
  /** Begins a file of an indexed mesh, in the order of its original file or of a mesh stream. */
  MeshFileFunction* writer = nullptr;
  WriteOrder writeOrder = WriteOrder::VerticesFirst;
  /** That for text on request, whose numbers have no places that are known before. */
  WriteOrder writeOrderOf(bool text) const
  {
    return text && this->writeOrder == WriteOrder::Interleaved ? WriteOrder::VerticesFirst
                                                               : this->writeOrder;
  }
  /** The scratch files of this writer in a workspace of `memory` bytes, bytes; null: it has none.
   */
  std::int64_t (*scratch)(const StreamInfo& mesh, std::int64_t memory, bool text) = nullptr;
  /**
   * Whether a mesh stream is written as such: in its order, with all columns, also those of a
   * conversion (OriginalId ...). Other files are like an original: in its order if that is known,
   * and without these columns.
   */
  bool isStreamed() const { return !this->writer || this->writeOrder == WriteOrder::Interleaved; }
  /** The most corners of a polygon in its files; larger ones become triangles. */
  std::int64_t maxCorners = std::numeric_limits<std::int64_t>::max();
  /** Writes the mesh of a .vsm file, instead of `writer`, for a format that wants more of it: the
   * last uses of vertices, or pieces with their points. The suffix is one for these cells. */
  WriteNotes (*writeVsm)(const std::filesystem::path& vsm, const std::filesystem::path& path,
    const WriteMeshOptions& options) = nullptr;

  /** The files that a mesh has besides the one that is named; null: none. A file that cannot be
   * read has none: whoever reads it gets the error. */
  std::vector<std::filesystem::path> (*furtherInputs)(const std::filesystem::path& path) = nullptr;
  std::vector<std::filesystem::path> (*furtherOutputs)(const std::filesystem::path& path) = nullptr;
};

// All formats, each defined in its folder.
extern const Format VsmFileFormat, StreamsFormat, PlyFormat, StlFormat, ObjFormat, OffFormat,
  MeditFormat, BinaryMeditFormat, GmshFormat, TetGenFormat, AbaqusFormat, NastranFormat, MfemFormat,
  NetgenFormat, ExodusFormat, LegacyVtkFormat, VtkXmlFormat, VtkHdfFormat;
/** The pieces of a .pvtp or .pvtu file, one after the other. */
SMG_EXPORT extern const Format ParallelVtkXmlFormat;

/** Format::parse of a function that reports progress only by the bytes it reads. */
template <void (*Parse)(InputFile&, RawMeshBuilder&)>
void parseWith(InputFile& file, RawMeshBuilder& builder, const MeshPart&, const ProgressFunction&)
{
  Parse(file, builder);
}

} // namespace smg
