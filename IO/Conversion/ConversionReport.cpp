// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include <nlohmann/json.hpp>

namespace smg
{

std::string ConversionReport::json(int indent) const
{
  nlohmann::ordered_json json;
  json["order"] = this->order;
  json["time_steps"] = this->time_steps;
  json["partitions"] = this->partitions;
  json["vertices"] = this->vertices;
  json["cells"] = this->cells;
  json["isolated_vertices"] = this->isolated_vertices;
  json["merged_points"] = this->merged_points;
  json["degenerate_cells"] = this->degenerate_cells;
  json["duplicate_cells"] = this->duplicate_cells;
  json["dropped_cells"] = this->dropped_cells;
  json["triangulated_polygons"] = this->triangulated_polygons;
  json["split_cells"] = this->split_cells;
  json["higher_order_cells"] = this->higher_order_cells;
  json["inverted_cells"] = this->inverted_cells;
  json["components"] = this->components;
  json["boundary_edges"] = this->boundary_edges;
  json["nonmanifold_edges"] = this->nonmanifold_edges;
  json["nonmanifold_vertices"] = this->nonmanifold_vertices;
  json["keeps_numbers"] = this->keeps_numbers;
  json["width"] = this->width;
  json["span"] = this->span;
  json["mean_width"] = this->mean_width;
  json["pool_bytes_peak"] = this->pool_bytes_peak;
  json["rss_bytes_peak"] = this->rss_bytes_peak;
  json["scratch_bytes_peak"] = this->scratch_bytes_peak;
  json["scratch_bytes_read"] = this->scratch_bytes_read;
  json["scratch_bytes_written"] = this->scratch_bytes_written;
  json["pages"] = this->pages;
  json["page_loads"] = this->page_loads;
  json["cpu_seconds"] = this->cpu_seconds;
  json["seconds"] = { { "import", this->seconds.import }, { "order", this->seconds.order },
    { "write", this->seconds.write }, { "total", this->seconds.total } };
  json["notes"] = this->notes;
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace smg
