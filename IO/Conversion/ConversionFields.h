// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "Solver/Core/Fields.h"
#include "smg/Convert.h"

#include <tuple>

// The entries of the report of a conversion, and of estimates.

namespace smg
{

template <>
inline constexpr auto Fields<ConversionReport::Seconds> = std::tuple{
  field("import", &ConversionReport::Seconds::import),
  field("order", &ConversionReport::Seconds::order),
  field("write", &ConversionReport::Seconds::write),
  field("total", &ConversionReport::Seconds::total),
};

template <>
inline constexpr auto Fields<ConversionReport> = std::tuple{
  field("order", &ConversionReport::order),
  field("time_steps", &ConversionReport::time_steps),
  field("partitions", &ConversionReport::partitions),
  field("vertices", &ConversionReport::vertices),
  field("cells", &ConversionReport::cells),
  field("isolated_vertices", &ConversionReport::isolated_vertices),
  field("merged_points", &ConversionReport::merged_points),
  field("degenerate_cells", &ConversionReport::degenerate_cells),
  field("duplicate_cells", &ConversionReport::duplicate_cells),
  field("dropped_cells", &ConversionReport::dropped_cells),
  field("triangulated_polygons", &ConversionReport::triangulated_polygons),
  field("split_cells", &ConversionReport::split_cells),
  field("higher_order_cells", &ConversionReport::higher_order_cells),
  field("inverted_cells", &ConversionReport::inverted_cells),
  field("components", &ConversionReport::components),
  field("boundary_edges", &ConversionReport::boundary_edges),
  field("nonmanifold_edges", &ConversionReport::nonmanifold_edges),
  field("nonmanifold_vertices", &ConversionReport::nonmanifold_vertices),
  field("keeps_numbers", &ConversionReport::keeps_numbers),
  field("width", &ConversionReport::width),
  field("span", &ConversionReport::span),
  field("mean_width", &ConversionReport::mean_width),
  field("pool_bytes_peak", &ConversionReport::pool_bytes_peak),
  field("rss_bytes_peak", &ConversionReport::rss_bytes_peak),
  field("scratch_bytes_peak", &ConversionReport::scratch_bytes_peak),
  field("scratch_bytes_read", &ConversionReport::scratch_bytes_read),
  field("scratch_bytes_written", &ConversionReport::scratch_bytes_written),
  field("pages", &ConversionReport::pages),
  field("page_loads", &ConversionReport::page_loads),
  field("cpu_seconds", &ConversionReport::cpu_seconds),
  field("seconds", &ConversionReport::seconds),
  field("notes", &ConversionReport::notes),
};

template <>
inline constexpr auto Fields<JobEstimate> = std::tuple{
  field("vertices", &JobEstimate::vertices),
  field("cells", &JobEstimate::cells),
  field("counted", &JobEstimate::counted),
  field("memory_bytes", &JobEstimate::memory_bytes),
  field("memory_limit", &JobEstimate::memory_limit),
  field("scratch_bytes", &JobEstimate::scratch_bytes),
  field("scratch_free", &JobEstimate::scratch_free),
  field("output_bytes", &JobEstimate::output_bytes),
  field("output_free", &JobEstimate::output_free),
  field("passes", &JobEstimate::passes, total::None,
    [](const JobEstimate&, int passes) { return passes > 0; }),
  field("cpu_seconds", &JobEstimate::cpu_seconds),
};

} // namespace smg
