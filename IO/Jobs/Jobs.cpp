// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/Jobs.h"

#include "IO/Conversion/ConversionFields.h"
#include "IO/Jobs/AreaJob.h"
#include "IO/Jobs/BlendJob.h"
#include "IO/Jobs/DeformJob.h"
#include "IO/Jobs/DistanceJob.h"
#include "IO/Jobs/ReadOptions.h"
#include "IO/Jobs/SimplifyJob.h"
#include "IO/Jobs/SmoothJob.h"
#include "IO/Jobs/SolveJob.h"
#include "IO/Simplification/SimplifyFields.h"
#include "Solver/Core/FieldsJson.h"
#include "Solver/Core/ReportFields.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace smg
{
namespace
{

template <class Kind>
std::unique_ptr<Job> make()
{
  return std::make_unique<Kind>();
}

constexpr JobKind Kinds[] = {
  { "solve", "Solve a Poisson problem on a mesh", make<SolveJob> },
  { "deform", "Deform a mesh by handles, keeping its details", make<DeformJob> },
  { "smooth", "Smooth a surface, or a column of the vertices of any mesh", make<SmoothJob> },
  { "blend", "Remove the steps of columns between patches of a mesh", make<BlendJob> },
  { "distance", "Measure the distance of all vertices from some of them", make<DistanceJob> },
  { "area", "Sum up areas or volumes: of vertices, by tags, in all", make<AreaJob> },
  { "simplify", "Simplify a surface, or that of a solid, by collapsing edges", make<SimplifyJob> },
};

} // namespace

std::span<const JobKind> jobKinds()
{
  return Kinds;
}

const JobKind& jobKind(std::string_view name)
{
  const auto found = std::ranges::find(Kinds, name, &JobKind::name);
  if (found == std::end(Kinds))
  {
    std::vector<std::string> names;
    std::ranges::transform(Kinds, std::back_inserter(names), &JobKind::name);
    throw Error('\'' + std::string(name) + "': the jobs are " + listed(names, "and") + '.');
  }
  return *found;
}

std::unique_ptr<Job> makeJob(std::string_view kind)
{
  return jobKind(kind).make();
}

nlohmann::ordered_json describeAll()
{
  nlohmann::ordered_json all;
  for (const JobKind& kind : Kinds)
  {
    all["jobs"][kind.name] = describe(*kind.make());
  }
  all["report"] = describeFields<Report>();
  all["simplify_report"] = describeFields<SimplifyReport>();
  all["estimate"] = describeFields<JobEstimate>();
  return all;
}

} // namespace smg
