// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/ArgumentColumns.h"
#include "IO/Conversion/OpenArrays.h"
#include "IO/Mesh/Columns.h"
#include "Python/C/Call.h"
#include "Python/C/Field.h"
#include "Python/C/Options.h"
#include "smg/VsmReader.h"

#include <utility>

namespace smg
{
namespace
{

smg_mesh* handleOf(
  std::unique_ptr<OpenedMesh> mesh, std::filesystem::path name, const ConversionOptions& options)
{
  auto handle = std::make_unique<smg_mesh>();
  handle->shared = std::make_shared<SharedMesh>(std::move(mesh), std::move(name), options);
  return handle.release();
}

ConversionOptions optionsOf(const char* text, bool isFile)
{
  const nlohmann::json json = optionsText(text, "options");
  return argument([&] { return conversionIn(JsonNode(json, "options"), isFile); });
}

void addColumn(smg_mesh& mesh, const char* name, bool ofCells, const smg_array* values)
{
  const std::shared_ptr<const OriginalOrder> order = mesh.shared->order();
  auto added = mesh.added
                 ? std::make_shared<AddedColumns>(*mesh.added)
                 : std::make_shared<AddedColumns>(
                     std::shared_ptr<const StoredMesh>(mesh.shared, &mesh.shared->mesh()), order);
  if (values)
  {
    added->add(ofCells, name, viewOf(values, "values"));
  }
  else
  {
    added->remove(ofCells, name);
  }
  mesh.added = added->isEmpty() ? nullptr : std::move(added);
}

/** Returns the notes of the writer as a JSON list. */
std::string saveMesh(
  smg_mesh& mesh, const char* path, const char* text, const ProgressFunction& progress)
{
  const nlohmann::json json = optionsText(text, "options");
  const JobLimits limits = argument(
    [&]
    {
      const JsonNode node(json, "options");
      node.requireObject({ "memory", "threads", "scratch" });
      return limitsIn(node, limitsOf(mesh.shared->options()));
    });
  ResultFile out = resultFile(*mesh.shared, mesh.added, nullptr, path, limits);
  const StoredMesh& stored = mesh.stored();
  out.chooseOrder(stored.info(), mesh.shared->mesh().conversion());
  const StreamInfo info = withoutArguments(stored.info());
  const auto source = stored.source(columnNames(info.vertexColumns), columnNames(info.cellColumns));
  const std::int64_t memory = limits.memory > 0 ? limits.memory : ConversionOptions::DefaultMemory;
  const nlohmann::json notes = out.write(stored, *source, MeshJob::writerMemory(memory), progress);
  return notes.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace
} // namespace smg

smg_status smg_open(
  const char* path, const char* options, smg_progress progress, void* user, smg_mesh** mesh)
{
  return smg::guarded(
    [&]
    {
      smg::required(mesh, "mesh") = nullptr;
      const std::filesystem::path file = &smg::required(path, "path");
      smg::ConversionOptions given = smg::optionsOf(options, true);
      smg::ConversionOptions opening = given;
      opening.progress = smg::progressOf(progress, user);
      *mesh = smg::handleOf(smg::openMesh(file, opening), file, given);
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
      smg::ConversionOptions given = smg::optionsOf(options, false);
      smg::ConversionOptions opening = given;
      opening.progress = smg::progressOf(progress, user);
      *mesh = smg::handleOf(smg::openArrays(ofPoints, ofCells, opening), {}, given);
    });
}

smg_status smg_add_column(smg_mesh* mesh, const char* name, int cells, const smg_array* values)
{
  return smg::guarded(
    [&] {
      smg::addColumn(smg::required(mesh, "mesh"), &smg::required(name, "name"), cells != 0, values);
    });
}

smg_status smg_counts(const smg_mesh* mesh, int64_t* vertices, int64_t* cells)
{
  return smg::guarded(
    [&]
    {
      const auto order = smg::required(mesh, "mesh").shared->order();
      smg::required(vertices, "vertices") = order->vertices().count;
      smg::required(cells, "cells") = order->cells().count;
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
