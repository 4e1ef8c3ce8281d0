// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/Distance.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Measures the distance of all vertices from some of them, or from walls. */
class SMG_EXPORT DistanceJob : public MeshJob
{
public:
  DistanceJob() { this->name = "distance"; }

  DistanceDescription description;
  DistanceOptions options;

  void setLimits(const JobLimits& limits) override;
  std::int64_t memoryLimit() const override { return this->options.memoryLimit; }
  std::span<const JobOption> table() const override;
  void check() const override;
  std::string resultHelp() const override { return meshWith("its distances"); }
  std::string resultColumns() const override { return "a distance"; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& solution, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;
  std::string found(const Report& report) const override;
  std::string fateOfIsolated(std::int64_t vertices, bool ordered) const override;

protected:
  bool keeps(const ColumnSpec& column, const StreamInfo& info) const override;
};

} // namespace smg
