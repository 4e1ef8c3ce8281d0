// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/MeshJob.h"
#include "IO/Vtk/PieceStream.h"
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

/** What a filter computes: a job on the mesh that its input delivers in pieces, out of core, or,
 * with its preview or as a whole, in memory. */
class JobTask
{
public:
  explicit JobTask(const char* kind);
  virtual ~JobTask() = default;

  std::vector<std::string> notes; ///< for the report

  MeshJob& job() { return *this->Job; }
  const MeshJob& job() const { return *this->Job; }
  /** Sets the columns of a job that is done to some. */
  void setColumns(std::vector<std::string> names);
  /** Sets the limits of the job. */
  void setLimits(const SolveOptions& options);

  /** Throws Error for problems that do not depend on the mesh, before the mesh is read. */
  virtual void check() const;
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
  /** A solution with what a report says of it. */
  struct Result
  {
    std::unique_ptr<Solution> solution;
    Report report;
  };

  /** What a result on a preview is. */
  virtual std::string resultOnPreview() const;
  /** What the report says of one with so many vertices. */
  std::string noteOnPreview(std::int64_t vertices) const;
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
  /** Before a run in memory, without the regions of which a preview has no point. */
  virtual void adaptTo(vtkPointSet& /*preview*/, const StreamInfo& /*info*/) {}
  /** Completes a result with what follows from it on the mesh. Throws Error and Cancelled. */
  virtual void complete(
    Result& /*result*/, const StoredMesh& /*mesh*/, const ProgressFunction& /*progress*/)
  {
  }

private:
  Result resultOn(const StoredMesh& mesh, const ProgressFunction& progress);

  const JobKind& Kind;
  std::unique_ptr<MeshJob> Job;
};

/** Makes the task of a filter from what its input delivered last, which may be nothing. */
using TaskOf = std::function<std::unique_ptr<JobTask>(vtkPointSet& input)>;

} // namespace smg
