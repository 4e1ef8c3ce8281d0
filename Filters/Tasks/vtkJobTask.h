// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/vtkStreamedTask.h"
#include "smg/Region.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkPointSet;

namespace smg
{

/** What a report says of a result on a preview, for example "this is the smoothed preview", of a
 * job by which the mesh is, for example, "smoothed". */
std::string noteOnPreview(
  std::int64_t vertices, const std::string& result, const std::string& done);

/** A task of a job that works on any stored mesh (smg/Smooth.h, smg/Blend.h, smg/Distance.h): on
 * the whole mesh out of core, and on its preview in memory. */
class JobTask : public StreamedTask
{
public:
  SolveOptions options;         ///< except for the progress function
  std::vector<Where> places;    ///< the parts of the mesh that its description names
  std::set<std::string> arrays; ///< those that it names besides, by their names

  PieceColumns columns() const override;
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) const override;
  SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) override;

protected:
  /** Both as for noteOnPreview(). */
  JobTask(std::string result, std::string done)
    : Result(std::move(result))
    , Done(std::move(done))
  {
  }

  /** Calls the function of the job. Throws Error and Cancelled. */
  virtual std::unique_ptr<Solution> run(
    const StoredMesh& mesh, const SolveOptions& options) const = 0;
  /** Before a run on a preview, from whose `places` regions that it has no point of are gone. */
  virtual void adaptTo(vtkPointSet& /*preview*/, const StreamInfo& /*info*/) {}
  /** Adds notes to a report. */
  virtual void complete(Report& /*report*/) const {}

private:
  std::set<std::string> names() const;
  std::unique_ptr<Solution> run(const StoredMesh& mesh, SolveOptions given,
    const ProgressFunction& progress, Report& report) const;

  std::string Result, Done;
};

} // namespace smg
