// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Fields.h"
#include "smg/Simplify.h"

#include <tuple>

// The entries of the report of a simplification.

namespace smg
{

template <>
inline constexpr auto Fields<SimplifyReport> = std::tuple{
  field("vertices_before", &SimplifyReport::vertices_before),
  field("cells_before", &SimplifyReport::cells_before),
  field("vertices", &SimplifyReport::vertices),
  field("cells", &SimplifyReport::cells),
  field("error", &SimplifyReport::error),
  field("dropped_bodies", &SimplifyReport::dropped_bodies),
  field("merged_vertices", &SimplifyReport::merged_vertices),
  field("resumed_vertices", &SimplifyReport::resumed_vertices),
  field("pool_bytes_peak", &SimplifyReport::pool_bytes_peak),
  field("rss_bytes_peak", &SimplifyReport::rss_bytes_peak),
  field("cpu_seconds", &SimplifyReport::cpu_seconds),
  field("seconds", &SimplifyReport::seconds),
  field("notes", &SimplifyReport::notes),
};

} // namespace smg
