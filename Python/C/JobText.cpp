// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/JobText.h"

#include "IO/Description/ParseDescriptions.h"
#include "IO/Description/ParseWhere.h"
#include "IO/Description/Sizes.h"
#include "IO/Jobs/BlendJob.h"
#include "IO/Jobs/DeformJob.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Jobs/SmoothJob.h"
#include "IO/Jobs/SolveJob.h"
#include "Python/C/Call.h"
#include "Python/C/Options.h"

#include <initializer_list>
#include <limits>
#include <vector>

namespace smg
{
namespace
{

/** Throws Error unless the description has no other keys than these and those of all jobs. */
void requireKeys(const JsonNode& node, std::initializer_list<const char*> own, bool solves = true)
{
  std::vector<const char*> keys(own);
  if (solves)
  {
    keys.insert(keys.end(), { "tolerance", "sweeps", "max_cycles", "in_core" });
  }
  keys.insert(keys.end(), LimitKeys);
  node.requireObject(keys);
}

/** The options that all jobs have that solve. `canBeAutomatic`: the tolerance. */
void readSolving(const JsonNode& node, SolvingJob& job, bool canBeAutomatic = false)
{
  SolveOptions& options = job.options();
  if (node.has("tolerance"))
  {
    const JsonNode tolerance = node.member("tolerance");
    options.tolerance = canBeAutomatic && tolerance.value() == "auto"
                          ? SolveOptions::AutomaticTolerance
                          : toleranceIn(tolerance);
  }
  if (node.has("sweeps"))
  {
    options.sweeps = static_cast<int>(node.member("sweeps").integer(1, 20));
  }
  if (node.has("max_cycles"))
  {
    options.maxCycles = countIn(node.member("max_cycles"));
  }
  if (node.has("in_core"))
  {
    options.inCore = flagIn(node.member("in_core"));
  }
}

/** Sets the folder of the checkpoint, and what is compared with it. */
void readCheckpoint(const JsonNode& node, const char* what, SolvingJob& job)
{
  if (node.has("checkpoint"))
  {
    job.options().checkpoint.folder = node.member("checkpoint").string();
    job.text = node.member(what).value().dump();
  }
}

MovedNormals normalsIn(const JsonNode& node)
{
  return node.has("normals") && choiceIn(node.member("normals"), { "recompute", "drop" }) == 1
           ? MovedNormals::Drop
           : MovedNormals::Recompute;
}

std::vector<Where> placesIn(const JsonNode& node, const char* key)
{
  return node.has(key) ? parsePlaces(node.member(key)) : std::vector<Where>{};
}

std::unique_ptr<MeshJob> solveJob(const JsonNode& node)
{
  requireKeys(node, { "problem", "acceleration", "checkpoint" });
  auto job = std::make_unique<SolveJob>();
  job->name = "problem";
  job->description = parseProblem(node.member("problem"));
  readSolving(node, *job, true);
  if (node.has("acceleration"))
  {
    job->solving.acceleration = static_cast<AccelerationKind>(
      choiceIn(node.member("acceleration"), { "automatic", "none", "chebyshev", "cg" }));
  }
  readCheckpoint(node, "problem", *job);
  return job;
}

std::unique_ptr<MeshJob> deformJob(const JsonNode& node)
{
  requireKeys(node, { "handles", "cycles", "weights", "normals", "checkpoint" });
  auto job = std::make_unique<DeformJob>();
  job->name = "handles";
  job->description = parseDeformation(node.member("handles"));
  job->description.applyTo(job->deforming);
  if (const std::optional<Weights> weights = parseWeights(node))
  {
    job->deforming.weights = *weights;
  }
  readSolving(node, *job);
  if (node.has("tolerance"))
  {
    job->deforming.cycles = 0;
  }
  if (node.has("cycles"))
  {
    if (node.has("tolerance"))
    {
      node.member("cycles").fail("does not go with tolerance: leave one out");
    }
    job->deforming.cycles = countIn(node.member("cycles"));
  }
  job->normals = normalsIn(node);
  readCheckpoint(node, "handles", *job);
  return job;
}

SmoothingSize sizeIn(const JsonNode& node)
{
  if (!node.isString())
  {
    const double value = node.number();
    if (value <= 0.0)
    {
      node.fail("must be above 0");
    }
    return { value, SmoothingSize::Mesh };
  }
  const std::optional<SmoothingSize> size = smoothingSizeOf(node.string());
  if (!size)
  {
    node.fail('\'' + node.string() +
              "' is not a size: give a number above 0, as 2.5, \"1%\" or \"6edges\"");
  }
  return *size;
}

std::unique_ptr<MeshJob> smoothJob(const JsonNode& node)
{
  requireKeys(node, { "size", "steps", "hold", "boundary", "keep_volume", "keep_edges", "orient",
                      "column", "normals" });
  auto job = std::make_unique<SmoothJob>();
  Smoothing& smoothing = job->smoothing;
  readSolving(node, *job);
  if (node.has("size"))
  {
    smoothing.size = sizeIn(node.member("size"));
  }
  if (node.has("steps"))
  {
    smoothing.steps = static_cast<int>(node.member("steps").integer(1, 1000));
  }
  smoothing.hold = placesIn(node, "hold");
  if (node.has("boundary"))
  {
    smoothing.boundary = static_cast<SmoothedBoundary>(
      choiceIn(node.member("boundary"), { "smooth", "fixed", "free" }));
  }
  if (node.has("keep_volume"))
  {
    smoothing.keepVolume = flagIn(node.member("keep_volume"));
  }
  if (node.has("keep_edges"))
  {
    smoothing.keepEdges = node.member("keep_edges").number();
  }
  smoothing.orient = node.has("orient") && flagIn(node.member("orient"));
  if (node.has("column"))
  {
    smoothing.column = node.member("column").columnName();
  }
  job->normals = normalsIn(node);
  return job;
}

std::unique_ptr<MeshJob> blendJob(const JsonNode& node)
{
  requireKeys(node, { "patch", "columns", "hold", "anchor", "seam" });
  auto job = std::make_unique<BlendJob>();
  BlendDescription& blend = job->description;
  readSolving(node, *job);
  blend.patch = node.member("patch").columnName();
  for (const JsonNode& column : node.member("columns").elements())
  {
    blend.columns.push_back(column.columnName());
  }
  blend.hold = placesIn(node, "hold");
  if (node.has("anchor"))
  {
    blend.anchor = node.member("anchor").number();
    if (blend.anchor < 0.0)
    {
      node.member("anchor").fail("must be at least 0");
    }
  }
  if (node.has("seam"))
  {
    blend.seam = static_cast<SeamGradient>(choiceIn(node.member("seam"), { "zero", "average" }));
  }
  return job;
}

std::unique_ptr<MeshJob> distanceJob(const JsonNode& node)
{
  requireKeys(node,
    { "from", "wall", "source", "group", "direction", "to", "accuracy", "within", "max_passes" },
    false);
  auto job = std::make_unique<DistanceJob>();
  job->name = "distance";
  DistanceDescription& distance = job->description;
  distance.from = placesIn(node, "from");
  const auto flag = [&node](const char* key) { return node.has(key) && flagIn(node.member(key)); };
  distance.wall = flag("wall");
  distance.source = flag("source");
  distance.group = flag("group");
  distance.direction = flag("direction");
  distance.to = placesIn(node, "to");
  if (node.has("accuracy"))
  {
    distance.accuracy = static_cast<PathAccuracy>(
      choiceIn(node.member("accuracy"), { "auto", "exact", "approximate" }));
  }
  if (node.has("within"))
  {
    distance.within = node.member("within").number();
  }
  if (distance.from.empty() && !distance.wall)
  {
    node.fail("needs \"from\", or \"wall\"");
  }
  if (node.has("max_passes"))
  {
    job->options.maxPasses = countIn(node.member("max_passes"));
  }
  return job;
}

} // namespace

std::unique_ptr<MeshJob> jobOf(
  const std::string& kind, const char* description, const JobLimits& defaults)
{
  const nlohmann::json json = optionsText(description, kind.c_str());
  return argument(
    [&]
    {
      const JsonNode node(json, kind);
      std::unique_ptr<MeshJob> job = kind == "solve"      ? solveJob(node)
                                     : kind == "deform"   ? deformJob(node)
                                     : kind == "smooth"   ? smoothJob(node)
                                     : kind == "blend"    ? blendJob(node)
                                     : kind == "distance" ? distanceJob(node)
                                                          : nullptr;
      if (!job)
      {
        throw Error('\'' + kind + "': the jobs are solve, deform, smooth, blend and distance.");
      }
      job->setLimits(limitsIn(node, defaults));
      job->check();
      return job;
    });
}

SimplifyCall simplifyCallOf(const char* description, const JobLimits& defaults)
{
  const nlohmann::json json = optionsText(description, "simplify");
  return argument(
    [&]
    {
      const JsonNode node(json, "simplify");
      node.requireObject(
        { "vertices", "error", "hold", "memory", "threads", "scratch", "checkpoint", "text" });
      if (!node.has("vertices") && !node.has("error"))
      {
        node.fail("needs \"vertices\", \"error\" or both");
      }
      SimplifyCall call;
      if (node.has("vertices"))
      {
        call.target.vertices =
          node.member("vertices").integer(SimplifyTarget::MinVertices, SimplifyTarget::MaxVertices);
      }
      if (node.has("error"))
      {
        call.target.error = node.member("error").number();
        if (call.target.error <= 0.0)
        {
          node.member("error").fail("must be a length above 0");
        }
      }
      call.options.hold = placesIn(node, "hold");
      call.options.text = node.has("text") && flagIn(node.member("text"));
      if (node.has("checkpoint"))
      {
        call.options.checkpoint = node.member("checkpoint").string();
      }
      const JobLimits limits = limitsIn(node, defaults);
      call.options.memoryLimit = limits.memory > 0 ? limits.memory : call.options.memoryLimit;
      call.options.threads = limits.threads;
      call.options.scratch = limits.scratch;
      return call;
    });
}

} // namespace smg
