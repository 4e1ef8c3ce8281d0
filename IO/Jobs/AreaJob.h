// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/Area.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Sums up areas or volumes: of each vertex, by tags, in all. */
class SMG_EXPORT AreaJob : public SolvingJob
{
public:
  AreaJob() { this->name = "area"; }

  AreaDescription description;
  SolveOptions running; ///< without what solves

  using SolvingJob::options;
  SolveOptions& options() override { return this->running; }
  std::span<const JobOption> table() const override;
  void check() const override {}
  std::string resultColumns() const override { return "an area"; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;
};

} // namespace smg
