// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** What a conversion did. Counts that are not known, or are none of such cells, are -1. */
struct ConversionReport
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

} // namespace smg
