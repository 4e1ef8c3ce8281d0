// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

namespace smg
{

/** A report on a conversion, for StateWriter and StateReader. */
struct ConversionReportState
{
  ConversionReport& report;

  template <class State>
  void exchange(State& state)
  {
    ConversionReport& r = this->report;
    state.part("report");
    state(r.order, r.time_steps, r.partitions, r.vertices, r.cells, r.isolated_vertices,
      r.merged_points, r.degenerate_cells, r.duplicate_cells, r.dropped_cells,
      r.triangulated_polygons, r.split_cells, r.higher_order_cells, r.inverted_cells, r.components,
      r.boundary_edges, r.nonmanifold_edges, r.nonmanifold_vertices, r.keeps_numbers, r.width,
      r.span, r.mean_width, r.pool_bytes_peak, r.rss_bytes_peak, r.scratch_bytes_read,
      r.scratch_bytes_written, r.pages, r.page_loads, r.cpu_seconds, r.seconds, r.notes);
  }
};

} // namespace smg
