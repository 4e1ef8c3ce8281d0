// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"
#include "Python/C/Call.h"
#include "Python/C/Handles.h"
#include "Python/C/Options.h"
#include "smg/Simplify.h"

#include <limits>

namespace smg
{
namespace
{

/** The options of smg_convert(). */
ConversionOptions convertingIn(const JsonNode& node)
{
  ConversionOptions options = conversionIn(node, true, { "codec", "restore" });
  options.codec = node.has("codec")
                    ? static_cast<Codec>(choiceIn(node.member("codec"), { "none", "lz4", "zstd" }))
                    : Codec::Zstd;
  options.restoreOrder = node.has("restore") && flagIn(node.member("restore"));
  for (const char* key : { "order", "weld", "cells", "codec", "time_step", "partition" })
  {
    if (options.restoreOrder && node.has(key))
    {
      node.member(key).fail("does not go with restore: leave one out");
    }
  }
  return options;
}

std::string simplifyMesh(
  const smg_mesh& mesh, const char* description, const char* path, const ProgressFunction& progress)
{
  const nlohmann::json json = optionsText(description, "simplify");
  SimplifyTarget target;
  SimplifyOptions options;
  argument(
    [&]
    {
      const JsonNode node(json, "simplify");
      node.requireObject({ "vertices", "error", "memory", "threads", "scratch", "checkpoint" });
      if (node.has("vertices"))
      {
        target.vertices =
          node.member("vertices").integer(4, std::numeric_limits<std::int64_t>::max());
      }
      if (node.has("error"))
      {
        target.error = node.member("error").number();
        if (target.error <= 0.0)
        {
          node.member("error").fail("must be a length above 0");
        }
      }
      if (!node.has("vertices") && !node.has("error"))
      {
        node.fail("needs \"vertices\", \"error\" or both");
      }
      if (node.has("checkpoint"))
      {
        options.checkpoint = node.member("checkpoint").string();
      }
      const JobLimits limits = limitsIn(node, limitsOf(mesh.shared->options()));
      options.memoryLimit = limits.memory > 0 ? limits.memory : options.memoryLimit;
      options.threads = limits.threads;
      options.scratch = limits.scratch;
    });
  options.progress = progress;
  return simplify(mesh.stored(), target, path, options).json();
}

/** The report that smg_convert() last returned on this thread. */
thread_local std::string ConvertReport;

} // namespace
} // namespace smg

smg_status smg_simplify(smg_mesh* mesh, const char* description, const char* path,
  smg_progress progress, void* user, const char** report)
{
  return smg::guarded(
    [&]
    {
      smg_mesh& given = smg::required(mesh, "mesh");
      given.text = smg::simplifyMesh(
        given, description, &smg::required(path, "path"), smg::progressOf(progress, user));
      if (report)
      {
        *report = given.text.c_str();
      }
    });
}

smg_status smg_convert(const char* in, const char* out, const char* options, smg_progress progress,
  void* user, const char** report)
{
  return smg::guarded(
    [&]
    {
      const char* const from = &smg::required(in, "in");
      const char* const to = &smg::required(out, "out");
      const nlohmann::json json = smg::optionsText(options, "options");
      smg::ConversionOptions given =
        smg::argument([&] { return smg::convertingIn(smg::JsonNode(json, "options")); });
      given.progress = smg::progressOf(progress, user);
      smg::ConvertReport = smg::convert(from, to, given).json();
      if (report)
      {
        *report = smg::ConvertReport.c_str();
      }
    });
}
