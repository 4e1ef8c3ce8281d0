// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/JobEstimate.h"
#include "IO/Formats/UsedFiles.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "Python/C/Call.h"
#include "Python/C/Field.h"
#include "Python/C/JobText.h"
#include "Python/C/Options.h"
#include "smg/Describe.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <utility>

namespace smg
{
namespace
{

nlohmann::ordered_json columnsText(const std::vector<ColumnSpec>& specs)
{
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const ColumnSpec& spec : specs)
  {
    columns.push_back({ { "name", spec.name }, { "type", std::string(nameOf(spec.type)) },
      { "components", spec.components } });
  }
  return columns;
}

std::string textOfJson(const nlohmann::ordered_json& json)
{
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string columnsText(const StreamInfo& info)
{
  return textOfJson({ { "vertices", columnsText(info.vertexColumns) },
    { "cells", columnsText(info.cellColumns) } });
}

/** `smg info --report`; `full`: with a description, for which the mesh is read. */
std::string infoText(const smg_mesh& mesh, bool full, const ProgressFunction& progress)
{
  const ConversionOptions& opened = mesh.shared->options();
  const smg_mesh own = mesh.withoutArguments();
  std::optional<MeshDescription> description;
  if (full)
  {
    DescribeOptions options;
    options.memoryLimit = opened.memoryLimit > 0 ? opened.memoryLimit : options.memoryLimit;
    options.progress = progress;
    description = describe(own.stored(), options);
  }
  MeshInfoOptions options;
  options.file = mesh.shared->name();
  options.conversion = mesh.shared->mesh().conversion();
  options.description = description ? &*description : nullptr;
  return meshInfo(own.stored(), options);
}

/** What a job is expected to cost. `fileOf` makes the file of its result; `known`: what the mesh
 * has, if that is known. */
template <class FileOf>
std::string estimateText(const EstimatedInput& in, const std::string& kind, const char* description,
  const char* path, const ConversionOptions& options, const FileOf& fileOf,
  const StreamInfo* known = nullptr)
{
  const JobLimits limits = limitsOf(options);
  if (kind == "simplify")
  {
    const SimplifyJob call = simplifyJobOf(description, limits);
    return simplifyEstimate(in, call.target, path ? path : "", call.options, options).json();
  }
  const std::unique_ptr<MeshJob> job = jobOf(kind, description, limits);
  if (known)
  {
    argument([&] { job->checkOn(*known); });
  }
  EstimatedResult result{ path ? path : "", job->addedTo(in.info) };
  result.memory = job->writerMemory();
  if (path)
  {
    result.order = fileOf(*job).expectedOrder(in.info);
  }
  JobEstimate estimate(in, result, job->costsOn(in.info), options);
  estimate.memory_limit = job->memoryLimit();
  return estimate.json();
}

std::string estimateText(
  const smg_mesh& mesh, const std::string& kind, const char* description, const char* path)
{
  const ConversionOptions& opened = mesh.shared->options();
  ConversionOptions options;
  apply(limitsOf(opened), options);
  EstimatedInput in(mesh.stored().file(), options);
  in.info = mesh.withoutArguments().stored().info();
  return estimateText(
    in, kind, description, path, options,
    [&](const MeshJob& job)
    { return resultFile(*mesh.shared, mesh.added, &job, path, { limitsOf(opened) }); },
    &mesh.stored().info());
}

std::string estimateFileText(const std::filesystem::path& file, const char* text,
  const std::string& kind, const char* description, const char* path)
{
  const nlohmann::json json = optionsText(text, "options");
  const ConversionOptions options =
    argument([&] { return conversionIn(JsonNode(json, "options"), true); });
  const EstimatedInput in(file, options);
  return estimateText(in, kind, description, path, options,
    [&](const MeshJob& job)
    {
      ResultFile::Options result;
      result.in = file;
      result.out = path;
      result.welds = options.weld.has_value();
      return ResultFile(job, std::move(result));
    });
}

std::string filesText(const std::filesystem::path& path)
{
  nlohmann::json files = nlohmann::json::array();
  for (const std::filesystem::path& file : filesOfMesh(path))
  {
    files.push_back(file.string());
  }
  return files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/** The text that smg_files() last returned on this thread. */
thread_local std::string FilesText;

/** The text that smg_estimate_file() last returned on this thread. */
thread_local std::string FileEstimate;

} // namespace
} // namespace smg

smg_status smg_info(smg_mesh* mesh, int full, smg_progress progress, void* user, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      smg_mesh& given = smg::required(mesh, "mesh");
      given.text = smg::infoText(given, full != 0, smg::progressOf(progress, user));
      *json = given.text.c_str();
    });
}

smg_status smg_files(const char* path, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      smg::FilesText = smg::filesText(&smg::required(path, "path"));
      *json = smg::FilesText.c_str();
    });
}

smg_status smg_describe(const char** json)
{
  return smg::guarded(
    [&]
    {
      static const std::string text = smg::describeAll().dump();
      smg::required(json, "json") = text.c_str();
    });
}

smg_status smg_estimate(
  smg_mesh* mesh, const char* job, const char* description, const char* path, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      smg_mesh& given = smg::required(mesh, "mesh");
      given.text = smg::estimateText(given, &smg::required(job, "job"), description, path);
      *json = given.text.c_str();
    });
}

smg_status smg_estimate_file(const char* file, const char* options, const char* job,
  const char* description, const char* path, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      smg::FileEstimate = smg::estimateFileText(
        &smg::required(file, "file"), options, &smg::required(job, "job"), description, path);
      *json = smg::FileEstimate.c_str();
    });
}

smg_status smg_columns(smg_mesh* mesh, smg_field* field, const char** json)
{
  return smg::guarded(
    [&]
    {
      smg::required(json, "json") = nullptr;
      if (field)
      {
        field->text = smg::columnsText(field->info());
        *json = field->text.c_str();
        return;
      }
      smg_mesh& given = smg::required(mesh, "mesh and field");
      given.text = smg::columnsText(given.withoutArguments().stored().info());
      *json = given.text.c_str();
    });
}
