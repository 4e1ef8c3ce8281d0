// SPDX-License-Identifier: BSD-3-Clause
#include "Python/C/JobText.h"

#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/ReadOptions.h"
#include "Python/C/Call.h"

namespace smg
{
namespace
{

/** Completes a new job by its description. */
void describeJob(
  Job& job, const std::string& kind, const char* description, const JobLimits& defaults)
{
  const nlohmann::json json = optionsText(description, kind.c_str());
  job.limits = defaults;
  readOptions(JsonNode(json, kind), job);
  job.setLimits(job.limits);
  job.check();
}

} // namespace

std::unique_ptr<MeshJob> jobOf(
  const std::string& kind, const char* description, const JobLimits& defaults)
{
  return argument(
    [&]
    {
      std::unique_ptr<MeshJob> job = makeMeshJob(kind);
      describeJob(*job, kind, description, defaults);
      return job;
    });
}

SimplifyJob simplifyJobOf(const char* description, const JobLimits& defaults)
{
  return argument(
    [&]
    {
      SimplifyJob job;
      describeJob(job, "simplify", description, defaults);
      return job;
    });
}

} // namespace smg
