// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/DescribedProblem.h"
#include "smg/ProblemDescription.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Solves a problem: the columns of SolvedMesh. */
class SMG_EXPORT SolveJob : public SolvingJob
{
public:
  SolveJob() { this->name = "problem"; }

  ProblemDescription description;
  SolveOptions solving;

  using SolvingJob::options;
  SolveOptions& options() override { return this->solving; }
  std::span<const JobOption> table() const override;
  void check() const override;
  std::string resultHelp() const override { return meshWith("its solution"); }
  std::string resultColumns() const override { return "a solution"; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  CoupledGroups coupled() const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  void prepareOn(const StoredMesh& mesh) override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;

protected:
  bool keeps(const ColumnSpec& column, const StreamInfo& info) const override;

private:
  /** The mesh with the columns of the problem. */
  std::unique_ptr<MeshSource> sourceOf(const StoredMesh& mesh) const;

  std::unique_ptr<DescribedProblem> Problem;
};

} // namespace smg
