// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/StreamedTask.h"
#include "IO/Jobs/MeshJob.h"
#include "smg/Region.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** What a report says of a result on a preview, for example "this is the smoothed preview", of a
 * job by which the mesh is, for example, "smoothed". */
std::string noteOnPreview(std::int64_t vertices, const char* result, const char* done);

/** The task of a job that works on any stored mesh: on the whole mesh out of core, and on its
 * preview in memory. */
class JobTask : public StreamedTask
{
public:
  std::vector<std::string> notes; ///< for the report

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
  JobTask(const char* result, const char* done)
    : ResultOnPreview(result)
    , Done(done)
  {
  }

  /** A solution with what a report says of it. */
  struct Result
  {
    std::unique_ptr<Solution> solution;
    Report report;
  };

  virtual MeshJob& job() = 0;
  const MeshJob& job() const { return const_cast<JobTask*>(this)->job(); }
  /** The parts of the mesh that the job names, of which a preview may lack some. */
  virtual std::vector<Where>& places() { return this->NoPlaces; }
  /** The arrays without which the job cannot be done. */
  virtual std::set<std::string> required() const;

  /** Before a run on a mesh, in memory or not. */
  virtual void prepareFor(const StreamInfo& /*info*/) {}
  /** Does the job. Throws Error and Cancelled. */
  virtual std::unique_ptr<Solution> run(const StoredMesh& mesh, const ProgressFunction& progress)
  {
    return this->job().solveOn(mesh, progress);
  }
  /** Before a run in memory, from whose places() regions that a preview has no point of are gone.
   */
  virtual void adaptTo(vtkPointSet& /*preview*/, const StreamInfo& /*info*/) {}
  /** Completes a result with what follows from it on the mesh. Throws Error and Cancelled. */
  virtual void complete(
    Result& /*result*/, const StoredMesh& /*mesh*/, const ProgressFunction& /*progress*/)
  {
  }

private:
  Result resultOn(const StoredMesh& mesh, const ProgressFunction& progress);

  const char *ResultOnPreview, *Done;
  std::vector<Where> NoPlaces;
};

} // namespace smg
