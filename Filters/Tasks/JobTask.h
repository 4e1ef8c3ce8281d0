// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "IO/Jobs/MeshJob.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Region.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <functional>
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

/** What a filter computes: a job on the mesh that its input delivers in pieces, out of core, or,
 * with its preview or as a whole, in memory. */
class JobTask
{
public:
  virtual ~JobTask() = default;

  std::vector<std::string> notes; ///< for the report

  /** Sets the limits of the job. */
  void setLimits(const SolveOptions& options);

  /** Throws Error for problems that do not depend on the mesh, before the mesh is read. */
  virtual void check() const { this->job().check(); }
  /** The arrays of the pieces that the job needs. */
  PieceColumns columns() const;
  /** What it is expected to cost on a mesh whose counts and span are known. */
  virtual Costs costs(const StreamInfo& info) const { return this->job().costsOn(info); }
  /** Whether the costs are those of a computation in memory, without scratch files. */
  virtual bool isInMemory() const { return false; }
  /** The values that its result has besides that mesh. */
  virtual AddedValues added(const StreamInfo& info) const { return this->job().addedTo(info); }

  /** Computes on the whole mesh, which has these columns, with scratch files in the folder
   * `scratch`; `mesh` is not needed afterwards. `report` receives the report of the solution with
   * additional notes. Throws Error and Cancelled. */
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report);
  /** Computes on a mesh in memory, which has cells, and sets the values at its points. Throws Error
   * and Cancelled. */
  virtual SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values);

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
    this->job().prepareOn(mesh);
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

/** Makes the task of a filter from what its input delivered last, which may be nothing. */
using TaskOf = std::function<std::unique_ptr<JobTask>(vtkPointSet& input)>;

} // namespace smg
