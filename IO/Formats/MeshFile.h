// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Format.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The kind of an input file, by its content if possible, else by its suffix: Vsm, Stream, Indexed,
 * or Unknown. The file may still be damaged or not exist. */
SMG_EXPORT MeshFileKind kindOfInput(const std::filesystem::path& path);

/** The times of the time steps of a mesh file; empty: it has none. Throws Error. */
SMG_EXPORT std::vector<double> timesOf(const std::filesystem::path& path);

/** The kind of an output file, by suffix; Unknown if meshes cannot be written with it. */
SMG_EXPORT MeshFileKind kindOfOutput(const std::filesystem::path& path);

/**
 * Checks an output file before the work: throws Error if meshes cannot be written with its suffix,
 * its format cannot hold these cells, it is a folder, or its folder does not exist or is not
 * writable.
 */
SMG_EXPORT void checkOutput(const std::filesystem::path& path, CellType cellType);

/** The same, before the mesh is known. */
SMG_EXPORT void checkOutput(const std::filesystem::path& path);

/** Throws Error if a file of any format cannot be created there: the path is a folder, a device or
 * a pipe, or its folder does not exist or is not writable. */
SMG_EXPORT void checkOutputPlace(const std::filesystem::path& path);

/** Throws Error if a file of the mesh `out` is one of the mesh `in`, see UsedFiles. `what`
 * describes the input, for example "the mesh itself". */
SMG_EXPORT void checkIsNotInput(const std::filesystem::path& in, const std::filesystem::path& out,
  const std::string& what = "the mesh itself");

/**
 * Refuses a file that its first bytes show to be something else than a mesh of `format`; see
 * refuseForeign(). To be called before the file is parsed, also for its counts.
 * @param name the name of the file, for the error
 * @param start its first FormatBytes, uncompressed
 * @param size of the file; none if it is not known
 */
void refuseForeignMesh(const std::string& name, std::string_view start,
  std::optional<std::uint64_t> size, const Format* format);

/** Options of importMesh(). */
struct ImportOptions
{
  CellChoice cells = CellChoice::Only;
  ProgressFunction progress;
  MeshPart part = {};
};

/**
 * Parses a mesh file of any format in formats() with a parser, optionally compressed by gzip. The
 * format is detected from the content, and from the suffix only if the content is ambiguous.
 * @throws Error with the file and the line, record or byte: the format is unknown, the file is
 * empty, truncated or inconsistent, a coordinate is not finite, a corner is not a vertex, there are
 * no cells, both triangles and tetrahedra, or no such part; Cancelled.
 */
SMG_EXPORT RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options = {});

/**
 * What importMesh() would make of the file, as far as its beginning up to the first cell tells: the
 * type of the cells, the precision, and the columns; no counts. Vertices are skipped, as fast as
 * the format allows. A column that may turn out to be without information is not told.
 * @return if the mesh can be imported, its type
 * @throws Error as importMesh(), where that can be seen up to there; Cancelled
 */
SMG_EXPORT StreamInfo lookAtMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options = {});

} // namespace smg
