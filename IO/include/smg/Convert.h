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

/** The stream order created by a conversion. */
enum class StreamOrder
{
  BreadthFirst, ///< from chosen starting vertices, component by component: `bfs`
  Axis,         ///< along the longest side of the bounds: `axis`
  Keep,         ///< the order of the cells in the file: `keep`
  Spectral      ///< by the Fiedler vector: `spectral`
};

/** The order with this name. Throws Error, which lists the orders, if there is none. */
SMG_EXPORT StreamOrder streamOrder(std::string_view name);

/** "bfs", "axis", "keep" or "spectral". */
SMG_EXPORT std::string_view nameOf(StreamOrder order);

/** The cells of a file that become the cells of the stream. */
enum class CellChoice
{
  Only,      ///< the existing type; a file with both types is an error
  Triangles, ///< polygons; volume cells are omitted
  Tetrahedra ///< volume cells; polygons are omitted
};

/** Options of convert(). */
struct ConversionOptions
{
  StreamOrder order = StreamOrder::BreadthFirst;
  /** The default memory limit in bytes. */
  static constexpr std::int64_t DefaultMemory = std::int64_t(256) << 20;

  /** The limit of the memory for the mesh and its order in bytes; 0: DefaultMemory. */
  std::int64_t memoryLimit = 0;
  /** The cells to keep of a file with surface cells and volume cells. */
  CellChoice cells = CellChoice::Only;
  /** Merges points within this distance of each other; 0: equal coordinates; none: no points. */
  std::optional<double> weld;
  /** Whether to write vertices and cells in the order of the original file: see writeRestored(). */
  bool restoreOrder = false;
  /** The compression of a .vsm file. */
  Codec codec = Codec::Zstd;
  /** The origin stored in a .vsm file, in UTF-8; empty: none. */
  std::string origin;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  ProgressFunction progress;
};

/** The report of a conversion. Counts that are unknown or not applicable are -1. */
struct SMG_EXPORT ConversionReport
{
  struct Seconds
  {
    double import = 0, order = 0, write = 0, total = 0;
  };

  std::string order;
  std::int64_t vertices = 0, cells = 0;
  std::int64_t isolated_vertices = 0;     ///< vertices of no cell: kept beside a .vsm stream
  std::int64_t merged_points = 0;         ///< points welded to others
  std::int64_t degenerate_cells = 0;      ///< cells without area or volume: flagged
  std::int64_t duplicate_cells = 0;       ///< cells with the corners of an earlier one: flagged
  std::int64_t dropped_cells = 0;         ///< omitted: points, lines, faces beside tetrahedra
  std::int64_t triangulated_polygons = 0; ///< polygons and strips split into triangles
  std::int64_t split_cells = 0;           ///< hexahedra, wedges, pyramids split into tetrahedra
  std::int64_t higher_order_cells = 0;    ///< cells with only their corners used
  std::int64_t inverted_cells = -1;       ///< tetrahedra of negative volume
  std::int64_t components = -1;           ///< connected by edges
  std::int64_t boundary_edges = -1;       ///< of one triangle
  std::int64_t nonmanifold_edges = -1;    ///< of more than two triangles
  std::int64_t nonmanifold_vertices = -1; ///< whose triangles are not one fan or one disc
  /** Whether OriginalId or OriginalCellId are columns of the file, not the indices in it. */
  bool keeps_numbers = false;
  std::int64_t width = -1; ///< maximum number of active vertices
  std::int64_t span = -1;  ///< largest index distance between vertices of a cell
  double mean_width = 0;
  std::int64_t pool_bytes_peak = 0; ///< accounted memory
  std::int64_t rss_bytes_peak = 0;  ///< of the process
  std::int64_t scratch_bytes_read = 0, scratch_bytes_written = 0;
  /** The number of pages of vertices, and of page loads during the breadth-first search. */
  std::int64_t pages = 0, page_loads = 0;
  double cpu_seconds = 0;
  Seconds seconds;
  /** Notes for the user. */
  std::vector<std::string> notes;

  /** As a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

/**
 * Converts a mesh of any size to a stream order and writes it, in a fixed amount of memory.
 *
 * Input: all formats of importMesh(), .vsm, and the streaming formats SMA, SMB, SVA and SVB, also
 * compressed by gzip; at most 4,294,967,294 vertices and as many cells.
 * Output, by the suffix: .vsm; .sma, .smb (triangles), .sva, .svb (tetrahedra); .ply, .vtp
 * (triangles), .vtu, .vtkhdf; with `restoreOrder` the formats of writeRestored().
 *
 * The stream is compact, without vertices of no cell, which a .vsm file stores separately.
 * Degenerate and duplicate cells are kept, flagged in the cell column `CellFlags`. The columns
 * `OriginalId` and `OriginalCellId` hold the indices in the file, from 0; if it already has such
 * columns of int64, those are kept instead, and columns of another type with these names are
 * renamed
 * (`OriginalId_1`), with a note.
 *
 * @throws Error if the input is invalid (see importMesh), the output cannot be written, the formats
 * are not compatible, the memory limit is below 16 MiB, or the disk has too little space for the
 * scratch files (checked before they are written); Cancelled. Neither output nor scratch files are
 * left behind then.
 */
SMG_EXPORT ConversionReport convert(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options = {});

} // namespace smg
