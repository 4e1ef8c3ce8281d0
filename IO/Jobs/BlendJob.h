// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/Blend.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Blends columns of the vertices between patches. */
class SMG_EXPORT BlendJob : public SolvingJob
{
public:
  BlendDescription description;
  SolveOptions solving;

  using SolvingJob::options;
  SolveOptions& options() override { return this->solving; }
  std::span<const JobOption> table() const override;
  void check() const override;
  std::string resultColumns() const override { return "these columns of vertices"; }
  std::vector<std::string> changedColumns() const override { return this->description.columns; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;
};

} // namespace smg
