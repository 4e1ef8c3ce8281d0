// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "smg/Describe.h"
#include "smg/VsmReader.h"

#include <nlohmann/json.hpp>

#include <type_traits>

// What is known of a mesh as JSON: the text that `smg info --report` writes and other languages
// read. Entries are in the order in which they are inserted here; those that do not apply to the
// kind of cells or of file are left out. docs/info.md describes them.

namespace smg
{
namespace
{

using Json = nlohmann::ordered_json;

const char* nameOf(Codec codec)
{
  constexpr const char* names[] = { "none", "lz4", "zstd" };
  return names[static_cast<int>(codec)];
}

Json entriesOf(const ColumnSpec& spec)
{
  return { { "name", spec.name }, { "type", std::string(nameOf(spec.type)) },
    { "components", spec.components } };
}

Json entriesOf(const std::vector<ColumnSpec>& specs)
{
  Json columns = Json::array();
  for (const ColumnSpec& spec : specs)
  {
    columns.push_back(entriesOf(spec));
  }
  return columns;
}

Json entriesOf(const Group& group)
{
  Json entries;
  entries["name"] = group.label();
  if (group.number)
  {
    entries["number"] = *group.number;
  }
  entries["of"] = nameOf(group.of);
  return entries;
}

Json entriesOf(const std::vector<Group>& groups)
{
  Json list = Json::array();
  for (const Group& group : groups)
  {
    list.push_back(entriesOf(group));
  }
  return list;
}

Json entriesOf(const std::vector<MeshDescription::Group>& groups)
{
  Json list = Json::array();
  for (const MeshDescription::Group& group : groups)
  {
    Json& entries = list.emplace_back(entriesOf(group.group));
    entries["count"] = group.count;
    entries["measure"] = group.measure;
  }
  return list;
}

Json valueOf(const MeshDescription::Number& number)
{
  return std::visit(
    []<class T>(T value) -> Json
    {
      if constexpr (std::is_same_v<T, std::monostate>)
      {
        return nullptr;
      }
      else
      {
        return value;
      }
    },
    number);
}

Json valuesOf(const std::vector<MeshDescription::Number>& numbers)
{
  Json values = Json::array();
  for (const MeshDescription::Number& number : numbers)
  {
    values.push_back(valueOf(number));
  }
  return values;
}

Json entriesOf(const std::vector<MeshDescription::Column>& columns)
{
  Json list = Json::array();
  for (const MeshDescription::Column& column : columns)
  {
    Json& entries = list.emplace_back(entriesOf(column.spec));
    entries["minimum"] = valuesOf(column.minimum);
    entries["maximum"] = valuesOf(column.maximum);
    entries["not_finite"] = column.not_finite;
    // The names of members are texts: values as they are written.
    for (const MeshDescription::Tag& tag : column.tags)
    {
      entries["tags"][valueOf(tag.value).dump()] = tag.count;
    }
  }
  return list;
}

void addTopology(const MeshDescription& mesh, Json& json)
{
  const bool isSurface = mesh.cell_type == CellType::Triangle;
  json["bodies"] = mesh.bodies;
  json["largest_body"] = mesh.largest_body;
  if (isSurface)
  {
    json["closed"] = mesh.closed;
  }
  json["consistently_wound"] = mesh.consistently_wound;
  json[isSurface ? "boundary_edges" : "boundary_faces"] = mesh.boundary_facets;
  json[isSurface ? "boundary_loops" : "boundary_surfaces"] = mesh.boundary_parts;
  if (!isSurface)
  {
    json["coincident_faces"] = mesh.coincident_facets;
    json["nonmanifold_faces"] = mesh.nonmanifold_facets;
  }
  json["nonmanifold_edges"] = mesh.nonmanifold_edges;
  json["nonmanifold_vertices"] = mesh.nonmanifold_vertices;
  if (isSurface)
  {
    json["turned_edges"] = mesh.turned_edges;
  }
  json["isolated_vertices"] = mesh.isolated_vertices;
  json["degenerate_cells"] = mesh.degenerate_cells;
  json["coincident_cells"] = mesh.coincident_cells;
  json["duplicate_cells"] = mesh.duplicate_cells;
  if (!isSurface)
  {
    json["inverted_cells"] = mesh.inverted_cells;
  }
}

/** JSON has no NaN: what is not known is written as null. */
void addShape(const MeshDescription& mesh, Json& json)
{
  json["edge_length"] = { { "minimum", mesh.edge_length.minimum },
    { "mean", mesh.edge_length.mean }, { "maximum", mesh.edge_length.maximum } };
  json["area"] = mesh.area;
  json["volume"] = mesh.volume;
  if (mesh.cell_type == CellType::Triangle)
  {
    json["turned_volume"] = mesh.turned_volume;
    json["boundary_length"] = mesh.boundary_length;
  }
  json["quality"] = { { "measure", "mean ratio" }, { "minimum", mesh.quality.minimum },
    { "mean", mesh.quality.mean }, { "slivers", mesh.quality.slivers },
    { "scaled_cells", mesh.quality.scaled_cells } };
  json["bounds"] = mesh.bounds;
  json["diagonal"] = mesh.diagonal;
  json["resolution"] = { { "offset", mesh.resolution.offset },
    { "digits", mesh.resolution.digits } };
}

Json entriesOf(const MeshDescription& mesh)
{
  Json json;
  json["cell_type"] = mesh.cell_type == CellType::Triangle ? "triangle" : "tetrahedron";
  json["vertices"] = mesh.vertices;
  json["cells"] = mesh.cells;
  addTopology(mesh, json);
  addShape(mesh, json);
  json["columns"] = { { "vertices", entriesOf(mesh.vertex_columns) },
    { "cells", entriesOf(mesh.cell_columns) } };
  json["groups"] = entriesOf(mesh.groups);
  json["pool_bytes_peak"] = mesh.pool_bytes_peak;
  json["notes"] = mesh.notes;
  return json;
}

Json expectedSolve(StreamInfo info, bool reorders)
{
  info.span = reorders ? usualSpan(info.cellType, info.vertices) : info.span;
  const Costs costs = solveCosts(info, 1, Weights::Cotangent, SolveOptions());
  return { { "memory_bytes", costs.memory }, { "scratch_bytes", costs.scratch },
    { "passes", costs.passes }, { "cpu_seconds", costs.seconds } };
}

/** As JSON; what is no UTF-8 in names of files and columns is replaced. */
std::string textOf(const Json& json, int indent)
{
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string MeshDescription::json(int indent) const
{
  return textOf(entriesOf(*this), indent);
}

std::string meshInfo(const StoredMesh& mesh, const MeshInfoOptions& options)
{
  const VsmReader reader(mesh.file(), nullptr, mesh.fileFingerprint());
  const StreamInfo& info = mesh.info();
  Json json;
  json["file"] = options.file.string();
  json["cell_type"] = info.cellType == CellType::Triangle ? "triangle" : "tetrahedron";
  json["vertices"] = info.vertices;
  json["cells"] = info.cells;
  json["isolated_vertices"] = reader.isolatedVertices();
  json["bounds"] = info.bounds;
  json["positions"] = info.doublePositions ? "float64" : "float32";
  json["width"] = info.width;
  json["span"] = info.span;
  json["mean_width"] = reader.meanWidth();
  json["columns"] = { { "vertices", entriesOf(info.vertexColumns) },
    { "cells", entriesOf(info.cellColumns) } };
  json["groups"] =
    options.description ? entriesOf(options.description->groups) : entriesOf(info.groups.groups);
  if (const ConversionReport* conversion = options.conversion)
  {
    json["time_steps"] = conversion->time_steps;
    json["partitions"] = conversion->partitions;
    json["notes"] = conversion->notes;
  }
  else
  {
    json["blocks"] = { { "vertices", reader.vertexBlocks() }, { "cells", reader.cellBlocks() } };
    json["codec"] = nameOf(reader.codec());
    json["bytes"] = reader.storedBytes();
    json["plain_bytes"] = reader.plainBytes();
    json["compression"] =
      static_cast<double>(reader.plainBytes()) / static_cast<double>(reader.storedBytes());
  }
  json["expected_solve"] = expectedSolve(info, options.reorders);
  if (options.description)
  {
    json["description"] = entriesOf(*options.description);
  }
  return textOf(json, options.indent);
}

} // namespace smg
