// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/MovedMesh.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Smooths the positions of a mesh, or a column of its vertices. */
class SMG_EXPORT SmoothJob : public SolvingJob
{
public:
  Smoothing smoothing;
  MovedNormals normals = MovedNormals::Recompute; ///< of smoothed positions

  using SolvingJob::options;
  SolveOptions& options() override { return this->smoothing; }
  std::span<const JobOption> table() const override;
  void check() const override { checkOptions(this->smoothing); }
  std::string resultHelp() const override;
  std::string resultColumns() const override;
  std::vector<std::string> changedColumns() const override;
  bool turnsCells() const override { return this->smoothing.orient; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;

protected:
  bool keeps(const ColumnSpec& column, const StreamInfo& info) const override;
};

} // namespace smg
