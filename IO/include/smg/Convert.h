// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The order that a conversion brings a mesh into. */
enum class StreamOrder
{
  BreadthFirst, ///< from planned starts, component after component: `bfs`
  Axis,         ///< along the longest side of the bounds: `axis`
  Keep,         ///< the order of the cells in the file: `keep`
  Spectral      ///< by the Fiedler vector: `spectral`
};

/** The order with this name. Throws Error naming the orders that there are. */
SMG_EXPORT StreamOrder streamOrder(std::string_view name);

/** "bfs", "axis", "keep" or "spectral". */
SMG_EXPORT std::string_view nameOf(StreamOrder order);

/** Which cells of a file become the cells of the stream. */
enum class CellChoice
{
  Only,      ///< the kind that there is; a file with both kinds is refused
  Triangles, ///< polygons; volume cells are left out
  Tetrahedra ///< volume cells; polygons are left out
};

/** How to convert. */
struct ConversionOptions
{
  StreamOrder order = StreamOrder::BreadthFirst;
  /** Memory limit that holds unless another one is given, bytes. */
  static constexpr std::int64_t DefaultMemory = std::int64_t(256) << 20;

  /** Promise on the memory of the mesh and its order, bytes; 0: DefaultMemory. */
  std::int64_t memoryLimit = 0;
  /** Which cells to keep of a file that has surface cells and volume cells. */
  CellChoice cells = CellChoice::Only;
  /** Merges points within this distance of each other; 0: equal coordinates; none: no points. */
  std::optional<double> weld;
  /** Of a file with time steps (VTKHDF): which one, from 0. */
  std::int64_t timeStep = 0;
  /** Of a file with partitions (VTKHDF): which one, from 0; none: all, joined. */
  std::optional<std::int64_t> partition;
  /** Writes vertices and cells in the order that they had in the first file: see writeRestored().
   */
  bool restoreOrder = false;
  /** How a .vsm file is compressed. */
  Codec codec = Codec::Zstd;
  /** What a .vsm file says of where it comes from, in UTF-8; empty: nothing. */
  std::string origin;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  ProgressFunction progress;
};

/** What a conversion did. Counts that are not known, or are none of such cells, are -1. */
struct SMG_EXPORT ConversionReport
{
  struct Seconds
  {
    double import = 0, order = 0, write = 0, total = 0;
  };

  std::string order;
  std::int64_t time_steps = 0, partitions = 0; ///< of the file that was read; 0: it has no such
  std::int64_t vertices = 0, cells = 0;
  std::int64_t isolated_vertices = 0;     ///< vertices of no cell: kept beside a .vsm stream
  std::int64_t merged_points = 0;         ///< points welded to others
  std::int64_t degenerate_cells = 0;      ///< cells without area or volume: flagged
  std::int64_t duplicate_cells = 0;       ///< cells with the corners of an earlier one: flagged
  std::int64_t dropped_cells = 0;         ///< points, lines, faces beside tetrahedra: left out
  std::int64_t triangulated_polygons = 0; ///< polygons and strips that became several triangles
  std::int64_t split_cells = 0;           ///< hexahedra, wedges, pyramids made tetrahedra
  std::int64_t higher_order_cells = 0;    ///< cells of which only the corners were used
  std::int64_t inverted_cells = -1;       ///< tetrahedra of negative volume
  std::int64_t components = -1;           ///< connected by edges
  std::int64_t boundary_edges = -1;       ///< of one triangle
  std::int64_t nonmanifold_edges = -1;    ///< of more than two triangles
  std::int64_t nonmanifold_vertices = -1; ///< whose triangles are not one fan or one disc
  /** Whether OriginalId or OriginalCellId are the file's own columns, not the places in it. */
  bool keeps_numbers = false;
  std::int64_t width = -1; ///< most vertices alive at once
  std::int64_t span = -1;  ///< largest index distance between vertices of a cell
  double mean_width = 0;
  std::int64_t pool_bytes_peak = 0; ///< accounted memory
  std::int64_t rss_bytes_peak = 0;  ///< of the process
  std::int64_t scratch_bytes_read = 0, scratch_bytes_written = 0;
  /** Pages of vertices, and how often one was loaded while a breadth-first order was made. */
  std::int64_t pages = 0, page_loads = 0;
  double cpu_seconds = 0;
  Seconds seconds;
  /** What a user should know. */
  std::vector<std::string> notes;

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

/**
 * Brings a mesh into a stream order and writes it, in a fixed amount of memory whatever its size.
 *
 * In: everything that importMesh() reads, .vsm, and the streaming formats SMA, SMB, SVA and SVB, or
 * one of them compressed by gzip; at most 4,294,967,294 vertices and as many cells.
 * Out, by the suffix: .vsm; .sma, .smb (triangles), .sva, .svb (tetrahedra); .ply, .vtp
 * (triangles), .vtu; with `restoreOrder` the formats of writeRestored().
 *
 * The stream is compact; vertices of no cell are left out of it, a .vsm file has them beside it;
 * degenerate and duplicate cells stay, with their flags in the cell column `CellFlags`. The columns
 * `OriginalId` and `OriginalCellId` keep the places in the file, from 0; if it has such columns of
 * int64 already, those are kept instead, and columns of another type that have these names get
 * others (`OriginalId_1`), with a note.
 *
 * @throws Error when the input is not valid (see importMesh), the output cannot be written, the
 * formats do not go together, the memory limit is below 16 MiB, or the disk has too
 * little room for the scratch files (told before they are written); Cancelled. No output and no
 * scratch file is left behind then.
 */
SMG_EXPORT ConversionReport convert(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options = {});

} // namespace smg
