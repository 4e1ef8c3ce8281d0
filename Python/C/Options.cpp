// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/Options.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/ReadOptions.h"
#include "Python/C/Call.h"
#include "smg/Error.h"

#include <limits>

namespace smg
{

namespace
{

/** No more than what a job may take, whose options it has. */
class LimitsAlone final : public Job
{
public:
  std::span<const JobOption> table() const override
  {
    static constexpr auto Limits = joined(LimitOptions, ScratchLimitOption);
    return Limits;
  }
  void setLimits(const JobLimits& given) override { this->limits = given; }
  void check() const override {}
};

} // namespace

JobLimits limitsIn(const JsonNode& object, const JobLimits& defaults)
{
  LimitsAlone job;
  job.setLimits(defaults);
  for (const JobOption& option : job.table())
  {
    if (object.has(option.key))
    {
      readOption(object.member(option.key), option, job);
    }
  }
  return job.limits;
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
    keys.insert(
      keys.end(), { "cells", "time_step", "partition", "checkpoint", "numbering", "problem" });
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
  if (object.has("problem"))
  {
    options.coupled = coupledGroups(parseProblem(object.member("problem")));
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
