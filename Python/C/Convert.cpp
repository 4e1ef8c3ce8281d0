// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"
#include "IO/Files/PartialProgress.h"
#include "IO/Formats/MeshFile.h"
#include "Python/C/Call.h"
#include "Python/C/Handles.h"
#include "Python/C/JobText.h"
#include "Python/C/Options.h"
#include "smg/Simplify.h"

#include <string>

namespace smg
{
namespace
{

/** The options of smg_convert(). */
ConversionOptions convertingIn(const JsonNode& node)
{
  ConversionOptions options = conversionIn(node, true, { "codec", "restore", "text" });
  options.codec = node.has("codec")
                    ? static_cast<Codec>(choiceIn(node.member("codec"), { "none", "lz4", "zstd" }))
                    : Codec::Zstd;
  options.text = node.has("text") && flagIn(node.member("text"));
  options.restoreOrder = node.has("restore") && flagIn(node.member("restore"));
  for (const char* key :
    { "order", "weld", "orient", "cells", "codec", "time_step", "partition", "problem" })
  {
    if (options.restoreOrder && node.has(key))
    {
      node.member(key).fail("does not go with restore: leave one out");
    }
  }
  return options;
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
      const char* const out = &smg::required(path, "path");
      if (!given.shared->name().empty())
      {
        smg::checkIsNotInput(given.shared->name(), out);
      }
      smg::SimplifyJob call = smg::simplifyJobOf(description, limitsOf(given.shared->options()));
      const smg::ProgressFunction told = smg::progressOf(progress, user);
      // "vertices" of the description itself is how many are wanted.
      if (const nlohmann::json text = smg::optionsText(description, "simplify");
          text.contains("hold"))
      {
        given.shared->requireRows(text.at("hold"), smg::partOf(told, 0.0, 0.05));
      }
      call.options.progress = smg::partOf(told, 0.05, 1.0);
      given.text =
        smg::simplify(given.withoutArguments().stored(), call.target, out, call.options).json();
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
