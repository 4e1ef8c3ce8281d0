// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "IO/Jobs/Job.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/**
 * A computation on a stored mesh, with what it is to compute: what it costs, what it adds to the
 * mesh, how it is done, and the mesh with its result. The command line and the interface for other
 * languages fill it, each in its way.
 */
class SMG_EXPORT MeshJob : public Job
{
public:
  /** The limit of the accounted memory, bytes. */
  virtual std::int64_t memoryLimit() const = 0;

  /** What help says of the result. */
  virtual std::string resultHelp() const = 0;
  /** The columns of the result for an error, for example "a solution"; empty if the result is the
   * mesh with other positions. */
  virtual std::string resultColumns() const = 0;
  /** The names of these columns, of the vertices, if the mesh has them already. */
  virtual std::vector<std::string> changedColumns() const { return {}; }
  /** Whether the result may have the corners of a cell in another order. */
  virtual bool turnsCells() const { return false; }
  /** The columns whose components are those of the solution, in order; of other positions the
   * column "Position". */
  virtual std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const = 0;
  /** Throws Error for what such a mesh certainly does not have, as columns that are named, before
   * it is read; solveOn() checks all. */
  virtual void checkOn(const StreamInfo& info) const;
  /** The groups that it couples, for the order of the mesh. */
  virtual CoupledGroups coupled() const { return {}; }
  /** What the computation is expected to cost on such a mesh. */
  virtual Costs costsOn(const StreamInfo& info) const = 0;
  /** The values that the result has besides the mesh, or in place of its own. */
  virtual AddedValues addedTo(const StreamInfo& info) const = 0;

  /** What the mesh with the result has. */
  StreamInfo resultOn(const StreamInfo& info) const;

  /** Prepares passResult(), for a solution that is computed elsewhere; solveOn() needs it, too. */
  virtual void prepareOn(const StoredMesh& /*mesh*/) {}
  /** Computes in memory instead of with scratch files, if that is another way. */
  virtual void keepInMemory() {}
  /** Computes the result; foreseeable failures are reported first. Throws Error; Cancelled. */
  virtual std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) = 0;
  /** Reads a stream to its end. */
  using Reader = std::function<void(MeshSource& result, const ProgressFunction&)>;
  /** Passes the mesh with the result, as a stream with all columns, to `read`, and adds to the
   * report what follows from it. */
  virtual void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read,
    Report& report, const ProgressFunction& progress) const = 0;

  /** What was found, in lines for a user; empty: the convergence of a solve. */
  virtual std::string found(const Report& /*report*/) const { return {}; }

  /** The treatment of this many isolated vertices in an output with all of the mesh, as the end of
   * a sentence. `ordered`: the output has the order of the mesh file. */
  virtual std::string fateOfIsolated(std::int64_t vertices, bool /*ordered*/) const
  {
    return vertices == 1 ? "stays where it is." : "stay where they are.";
  }

  /** Bytes for the buffers of a writer while the solution holds its memory. */
  std::int64_t writerMemory() const { return writerMemory(this->memoryLimit()); }
  /** The same of a job with this limit. */
  static std::int64_t writerMemory(std::int64_t memoryLimit);

protected:
  /** Whether the mesh with the result has a column that is none of the result. */
  virtual bool keeps(const ColumnSpec& /*column*/, const StreamInfo& /*info*/) const
  {
    return true;
  }
  /** What help says of a result that is the mesh with `columns` besides its own. */
  static std::string meshWith(const std::string& columns);
  /** The values of a result that has these columns of the vertices with other values. */
  static AddedValues replacedIn(const StreamInfo& info, const std::vector<std::string>& columns);
};

/** A job that solves equations. */
class SMG_EXPORT SolvingJob : public MeshJob
{
public:
  /** Also those of the job. With a folder for a checkpoint, solveOn() sets its texts. */
  virtual SolveOptions& options() = 0;
  const SolveOptions& options() const { return const_cast<SolvingJob*>(this)->options(); }
  /** A text that is another one if what is to be done is, for a checkpoint. */
  std::string text;

  void setLimits(const JobLimits& limits) override;
  std::int64_t memoryLimit() const override { return this->options().memoryLimit; }
  void keepInMemory() override
  {
    this->options().inCore = true;
    this->options().checkpoint = {};
  }
  /** Sets the options that depend on the mesh and on the caller. */
  void complete(const StoredMesh& mesh, const ProgressFunction& progress);
};

} // namespace smg
