// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/MeshPart.h"
#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"
#include "smg/WriteMesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

class InputFile;
class RawMeshBuilder;
class RestoredMesh;

/** How a file holds its mesh. */
enum class MeshFileKind
{
  Vsm,     ///< the container of this library
  Stream,  ///< cells and vertices in the order of a stream
  Indexed, ///< vertices and cells that name them by their numbers, in any order
  Unknown  ///< none of these
};

/** A suffix that the files of a format have, and the cells that are written under it. */
struct FileSuffix
{
  std::string_view text; ///< in lower case, with the dot
  bool triangles = true, tetrahedra = true;

  bool holds(CellType cells) const
  {
    return cells == CellType::Triangle ? this->triangles : this->tetrahedra;
  }
};

/** What a file says of its mesh, or its size lets guess. */
struct FileCounts
{
  std::int64_t vertices = 0, cells = 0;
  int corners = 3;              ///< of a cell
  std::int64_t columnBytes = 0; ///< of all columns of the mesh
  bool counted = false;         ///< whether the file says it
};

/** Bytes that a vertex takes in a file, with the cells that come to it: two triangles, six
 * tetrahedra. */
struct VertexShare
{
  std::int64_t bytes = 75;
  int corners = 3;
};

/** A sentence for each thing that a written file does not hold as the mesh has it. */
using WriteNotes = std::vector<std::string>;

/** As many bytes of the beginning of a file as tell its format. */
inline constexpr std::size_t FormatBytes = 4096;

/**
 * All that there is to know of a file format: what reads, writes and lists formats knows them by
 * the table of these (IO/AnyFormat/FormatTable.h) alone. A format lives in a folder of its own;
 * what it cannot do is null.
 */
struct Format
{
  std::string_view name;
  std::span<const FileSuffix> suffixes;
  /** What it holds beside positions and cells, for tables and help. */
  std::string_view attributes;
  MeshFileKind kind = MeshFileKind::Indexed;

  /** Whether the first bytes of a file have the sign of this format and of no other. */
  bool (*hasSign)(std::string_view start) = nullptr;
  /**
   * Whether the first bytes look like it, for a format without a sign.
   * @param size of the file, if it is known
   */
  bool (*looksRight)(std::string_view start, std::optional<std::uint64_t> size) = nullptr;

  /**
   * Parses a file as a stream and gives the mesh to the builder. Of the builder's MeshError makes
   * an Error with the place in the file, or leaves it to the caller.
   */
  void (*parse)(InputFile& file, RawMeshBuilder& builder, const MeshPart& part,
    const ProgressFunction& progress) = nullptr;
  /** What a file that is not compressed says at its beginning; none if it is too short for it. */
  std::optional<FileCounts> (*counts)(InputFile& file, const MeshPart& part) = nullptr;
  /** Whether its files have time steps and partitions. Else `part` is the whole mesh. */
  bool hasParts = false;
  /** What its size lets guess otherwise. */
  VertexShare share = {};

  /** Writes a mesh stream in its order, in one pass. The suffix is one that holds the cells. */
  WriteNotes (*write)(MeshSource& source, const std::filesystem::path& path,
    const WriteMeshOptions& options) = nullptr;
  /** Instead of `write`, of a .vsm file: for a format that has to read the mesh more than once. */
  WriteNotes (*writeVsm)(const std::filesystem::path& vsm, const std::filesystem::path& path,
    const ProgressFunction& progress) = nullptr;
  /**
   * Writes a mesh in the order of the file that it was made of: reads it once. The file gets its
   * name when it is complete.
   */
  WriteNotes (*restore)(RestoredMesh& mesh, const std::filesystem::path& path) = nullptr;
};

/** Format::parse of a function that does not tell progress other than by the bytes it reads. */
template <void (*Parse)(InputFile&, RawMeshBuilder&)>
void parseWith(InputFile& file, RawMeshBuilder& builder, const MeshPart&, const ProgressFunction&)
{
  Parse(file, builder);
}

} // namespace smg
