// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/Options.h"

#include "Python/C/Call.h"
#include "smg/Error.h"

#include <limits>

namespace smg
{

JobLimits limitsIn(const JsonNode& object, const JobLimits& defaults)
{
  constexpr std::int64_t MaxThreads = 1024;
  JobLimits limits = defaults;
  if (object.has("memory"))
  {
    limits.memory = bytesIn(object.member("memory"));
  }
  if (object.has("threads"))
  {
    limits.threads = static_cast<int>(object.member("threads").integer(0, MaxThreads));
  }
  if (object.has("scratch"))
  {
    limits.scratch = folderIn(object.member("scratch"));
  }
  if (object.has("scratch_limit"))
  {
    limits.scratchLimit = bytesIn(object.member("scratch_limit"));
  }
  return limits;
}

WritingOptions writingOptions(const char* options, const JobLimits& defaults)
{
  const nlohmann::json json = optionsText(options, "options");
  return argument(
    [&]
    {
      const JsonNode node(json, "options");
      node.requireObject({ "memory", "threads", "scratch", "text" });
      return WritingOptions{ limitsIn(node, defaults),
        node.has("text") && flagIn(node.member("text")) };
    });
}

double weldIn(const JsonNode& node)
{
  return numberIn(node, { .least = 0.0 });
}

ConversionOptions conversionIn(
  const JsonNode& object, bool isFile, std::initializer_list<const char*> more)
{
  constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
  std::vector<const char*> keys{ "weld", "orient", "order" };
  keys.insert(keys.end(), LimitKeys);
  if (isFile)
  {
    keys.insert(keys.end(), { "cells", "time_step", "partition", "checkpoint", "numbering" });
  }
  keys.insert(keys.end(), more);
  object.requireObject(keys);
  ConversionOptions options;
  options.codec = Codec::Lz4;
  apply(limitsIn(object), options);
  if (object.has("weld"))
  {
    options.weld = weldIn(object.member("weld"));
  }
  options.orient = object.has("orient") && flagIn(object.member("orient"));
  if (object.has("order"))
  {
    options.order = static_cast<StreamOrder>(
      choiceIn(object.member("order"), { "bfs", "axis", "keep", "spectral" }));
  }
  if (object.has("cells"))
  {
    options.cells = choiceIn(object.member("cells"), { "triangles", "tets" }) == 0
                      ? CellChoice::Triangles
                      : CellChoice::Tetrahedra;
  }
  if (object.has("time_step"))
  {
    options.timeStep = object.member("time_step").integer(0, Most);
  }
  if (object.has("partition"))
  {
    options.partition = object.member("partition").integer(0, Most);
  }
  if (object.has("numbering"))
  {
    options.numbering =
      static_cast<Numbering>(choiceIn(object.member("numbering"), { "columns", "rows" }));
  }
  if (object.has("checkpoint"))
  {
    options.checkpoint = folderIn(object.member("checkpoint"));
  }
  return options;
}

void apply(const JobLimits& limits, ConversionOptions& options)
{
  options.memoryLimit = limits.memory;
  options.threads = limits.threads;
  options.scratch = limits.scratch;
  options.scratchLimit = limits.scratchLimit;
}

JobLimits limitsOf(const ConversionOptions& options)
{
  return { options.memoryLimit, options.threads, options.scratch, options.scratchLimit };
}

} // namespace smg
