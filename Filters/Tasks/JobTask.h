// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/StreamedTask.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/Region.h"

#include <memory>
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

/** The task of a job that works on any stored mesh: on the whole mesh out of core, and on its
 * preview in memory. */
class JobTask : public StreamedTask
{
public:
  /** Sets the limits of the job. */
  void setLimits(const SolveOptions& options);

  void check() const override { this->job().check(); }
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override { return this->job().costsOn(info); }
  AddedValues added(const StreamInfo& info) const override { return this->job().addedTo(info); }
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) override;
  SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) override;

protected:
  /** Both as for noteOnPreview(). */
  JobTask(std::string result, std::string done)
    : Result(std::move(result))
    , Done(std::move(done))
  {
  }

  virtual MeshJob& job() = 0;
  const MeshJob& job() const { return const_cast<JobTask*>(this)->job(); }
  /** The parts of the mesh that the job names, of which a preview may lack some. */
  virtual std::vector<Where>& places() = 0;

  /** Does the job. Throws Error and Cancelled. */
  virtual std::unique_ptr<Solution> run(const StoredMesh& mesh, const ProgressFunction& progress)
  {
    return this->job().solveOn(mesh, progress);
  }
  /** Before a run on a preview, from whose places() regions that it has no point of are gone. */
  virtual void adaptTo(vtkPointSet& /*preview*/, const StreamInfo& /*info*/) {}
  /** Adds notes to a report. */
  virtual void complete(Report& /*report*/) const {}

private:
  std::unique_ptr<Solution> run(
    const StoredMesh& mesh, const ProgressFunction& progress, Report& report);

  std::string Result, Done;
};

} // namespace smg
