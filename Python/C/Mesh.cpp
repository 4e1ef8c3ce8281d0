// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/TriangulateArrays.h"
#include "IO/Conversion/OpenArrays.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Mesh/Columns.h"
#include "Python/C/Call.h"
#include "Python/C/Field.h"
#include "Python/C/Options.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <utility>

namespace smg
{
namespace
{

/** Whether a description has a WHERE with numbers of vertices. */
bool namesVertices(const nlohmann::json& node)
{
  return node.is_structured() && ((node.is_object() && node.contains("vertices")) ||
                                   std::ranges::any_of(node, &namesVertices));
}

smg_mesh* handleOf(std::unique_ptr<OpenedMesh> mesh, std::filesystem::path name, InputState state,
  const ConversionOptions& options)
{
  auto handle = std::make_unique<smg_mesh>();
  handle->shared =
    std::make_shared<SharedMesh>(std::move(mesh), std::move(name), std::move(state), options);
  return handle.release();
}

ConversionOptions optionsOfArrays(const char* text)
{
  const nlohmann::json json = optionsText(text, "options");
  return argument([&] { return conversionIn(JsonNode(json, "options"), false); });
}

void addColumn(smg_mesh& mesh, const std::string& name, bool ofCells, const smg_array& values,
  bool isArgument, const ProgressFunction& progress)
{
  const ArrayView view = viewOf(&values, "values");
  auto added = mesh.added ? std::make_shared<AddedColumns>(*mesh.added)
                          : std::make_shared<AddedColumns>(
                              std::shared_ptr<const StoredMesh>(mesh.shared, &mesh.shared->mesh()),
                              mesh.shared->order(progress));
  added->add(ofCells, name, view, isArgument);
  mesh.added = std::move(added);
}

void removeColumn(smg_mesh& mesh, const std::string& name, bool ofCells)
{
  if (mesh.added)
  {
    auto others = std::make_shared<AddedColumns>(*mesh.added);
    others->remove(ofCells, name);
    mesh.added = others->isEmpty() ? nullptr : std::move(others);
  }
}

/** Returns the notes of the writer as a JSON list. */
std::string saveMesh(
  smg_mesh& mesh, const char* path, const char* text, const ProgressFunction& progress)
{
  const WritingOptions options = writingOptions(text, limitsOf(mesh.shared->options()));
  const smg_mesh own = mesh.withoutArguments();
  ResultFile out = resultFile(*own.shared, own.added, nullptr, path, options);
  const StoredMesh& stored = own.stored();
  const StreamInfo& info = stored.info();
  out.chooseOrder(stored, own.shared->mesh().conversion(), partOf(progress, 0.0, 0.0));
  const auto source = stored.source(columnNames(info.vertexColumns), columnNames(info.cellColumns));
  const std::int64_t memory =
    options.limits.memory > 0 ? options.limits.memory : ConversionOptions::DefaultMemory;
  const nlohmann::json notes = out.write(stored, *source, MeshJob::writerMemory(memory), progress);
  return notes.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace

void SharedMesh::requireRows(const nlohmann::json& description, const ProgressFunction& progress)
{
  if (namesVertices(description) &&
      findColumn(this->Mesh->info().vertexColumns, OriginalIdSpec) >= 0 &&
      this->order(progress)->vertices().column.empty())
  {
    throw ArgumentError("vertices: the column OriginalId of this mesh has the numbers of another "
                        "mesh, as that of a simplified one: choose vertices by the nearest to "
                        "points or, for other jobs than simplify, by a mask.");
  }
}

} // namespace smg

smg_status smg_open(
  const char* path, const char* options, smg_progress progress, void* user, smg_mesh** mesh)
{
  return smg::guarded(
    [&]
    {
      smg::required(mesh, "mesh") = nullptr;
      const std::filesystem::path file = &smg::required(path, "path");
      const nlohmann::json json = smg::optionsText(options, "options");
      const smg::JsonNode node(json, "options");
      smg::ConversionOptions given =
        smg::argument([&] { return smg::conversionIn(node, true, { "welded" }); });
      smg::ConversionOptions opening = given;
      opening.progress = smg::progressOf(progress, user);
      if (node.has("welded"))
      {
        given.weld = smg::argument([&] { return smg::weldIn(node.member("welded")); });
      }
      smg::InputState state(file);
      *mesh = smg::handleOf(smg::openMesh(file, opening), file, std::move(state), given);
    });
}

smg_status smg_open_arrays(const smg_array* points, const smg_array* cells, const char* options,
  smg_progress progress, void* user, smg_mesh** mesh)
{
  return smg::guarded(
    [&]
    {
      smg::required(mesh, "mesh") = nullptr;
      const smg::ArrayView ofPoints = smg::viewOf(points, "points");
      const smg::ArrayView ofCells = smg::viewOf(cells, "cells");
      smg::ConversionOptions given = smg::optionsOfArrays(options);
      smg::ConversionOptions opening = given;
      opening.progress = smg::progressOf(progress, user);
      *mesh = smg::handleOf(smg::openArrays(ofPoints, ofCells, opening), {}, {}, given);
    });
}

smg_status smg_triangulate(const smg_array* points, const smg_array* corners,
  const smg_array* offsets, smg_progress progress, void* user, int64_t* triangles)
{
  return smg::guarded(
    [&]
    {
      smg::triangulateArrays(smg::viewOf(points, "points"), smg::viewOf(corners, "corners"),
        smg::viewOf(offsets, "offsets"), smg::progressOf(progress, user),
        &smg::required(triangles, "triangles"));
    });
}

smg_status smg_add_column(smg_mesh* mesh, const char* name, int cells, const smg_array* values,
  smg_progress progress, void* user)
{
  return smg::guarded(
    [&]
    {
      smg::addColumn(smg::required(mesh, "mesh"), &smg::required(name, "name"), cells != 0,
        smg::required(values, "values"), false, smg::progressOf(progress, user));
    });
}

smg_status smg_add_argument(smg_mesh* mesh, const char* name, int cells, const smg_array* values,
  smg_progress progress, void* user)
{
  return smg::guarded(
    [&]
    {
      smg::addColumn(smg::required(mesh, "mesh"), &smg::required(name, "name"), cells != 0,
        smg::required(values, "values"), true, smg::progressOf(progress, user));
    });
}

smg_status smg_remove_column(smg_mesh* mesh, const char* name, int cells)
{
  return smg::guarded([&]
    { smg::removeColumn(smg::required(mesh, "mesh"), &smg::required(name, "name"), cells != 0); });
}

smg_status smg_conversion(smg_mesh* mesh, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg_mesh& given = smg::required(mesh, "mesh");
      const char*& text = smg::required(json, "json");
      const smg::ConversionReport* const conversion = given.shared->mesh().conversion();
      nlohmann::ordered_json report;
      if (conversion)
      {
        report = nlohmann::ordered_json::parse(conversion->json());
        report["changes"] = conversion->changes();
      }
      given.text = report.dump();
      text = given.text.c_str();
    });
}

smg_status smg_counts(const smg_mesh* mesh, int64_t* vertices, int64_t* cells)
{
  return smg::guarded(
    [&]
    {
      const smg::SharedMesh& given = *smg::required(mesh, "mesh").shared;
      smg::required(vertices, "vertices") = given.vertices();
      smg::required(cells, "cells") = given.mesh().info().cells;
    });
}

smg_status smg_elements(const smg_mesh* mesh, smg_progress progress, void* user, int64_t* elements)
{
  return smg::guarded(
    [&]
    {
      const smg::OpenedMesh& given = smg::required(mesh, "mesh").shared->mesh();
      smg::required(elements, "elements") =
        smg::countElements(given, given.conversion(), smg::progressOf(progress, user));
    });
}

smg_status smg_merged(
  smg_mesh* mesh, smg_progress progress, void* user, int64_t* count, int64_t* rows, int64_t* kept)
{
  return smg::guarded(
    [&]
    {
      smg::SharedMesh& given = *smg::required(mesh, "mesh").shared;
      std::vector<smg::MergedRow> merged;
      if (given.options().weld)
      {
        merged = given.order(smg::progressOf(progress, user))->merged();
      }
      smg::required(count, "count") = static_cast<std::int64_t>(merged.size());
      for (std::size_t i = 0; i < merged.size() && rows && kept; ++i)
      {
        rows[i] = merged[i].row;
        kept[i] = merged[i].kept;
      }
    });
}

smg_status smg_save_mesh(smg_mesh* mesh, const char* path, const char* options,
  smg_progress progress, void* user, const char** notes)
{
  return smg::guarded(
    [&]
    {
      smg_mesh& given = smg::required(mesh, "mesh");
      given.text = smg::saveMesh(
        given, &smg::required(path, "path"), options, smg::progressOf(progress, user));
      if (notes)
      {
        *notes = given.text.c_str();
      }
    });
}

void smg_close_mesh(smg_mesh* mesh)
{
  delete mesh;
}
