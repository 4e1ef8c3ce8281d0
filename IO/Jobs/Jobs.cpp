// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Jobs/Jobs.h"

#include "IO/Conversion/ConversionFields.h"
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

/** Of jobs that nothing knows but by their tables; each in its own file. */
std::unique_ptr<Job> makeAreaJob();
std::unique_ptr<Job> makeBlendJob();

namespace
{

template <class Kind>
std::unique_ptr<Job> make()
{
  return std::make_unique<Kind>();
}

constexpr JobKind Kinds[] = {
  { "solve", "Solve a Poisson problem on a mesh", "solving", "Solution on", "solved on",
    make<SolveJob> },
  { "deform", "Deform a mesh by handles, keeping its details", "deforming", "Deformation of",
    "deformed", make<DeformJob> },
  { "smooth", "Smooth a surface, or a column of the vertices of any mesh", "smoothing",
    "Smoothing of", "smoothed", make<SmoothJob> },
  { "blend", "Remove the steps of columns between patches of a mesh", "blending", "Blend on",
    "blended", makeBlendJob },
  { "distance", "Measure the distance of all vertices from some of them", "measuring",
    "Distances on", "measured", make<DistanceJob> },
  { "area", "Sum up areas or volumes: of vertices, by tags, in all", "measuring", "Areas of",
    "measured", makeAreaJob },
  { "simplify", "Simplify a surface, or that of a solid, by collapsing edges", "simplifying",
    "Simplification of", "simplified", make<SimplifyJob> },
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

std::unique_ptr<MeshJob> makeMeshJob(std::string_view kind)
{
  std::unique_ptr<Job> job = makeJob(kind);
  if (auto* const ofMesh = dynamic_cast<MeshJob*>(job.get()))
  {
    job.release();
    return std::unique_ptr<MeshJob>(ofMesh);
  }
  throw Error(
    '\'' + std::string(kind) + "': its result is another mesh, with a function of its own.");
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
