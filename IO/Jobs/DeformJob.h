// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Jobs/MeshJob.h"
#include "smg/Deform.h"
#include "smg/DeformationDescription.h"
#include "smg/MovedMesh.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Deforms a mesh by handles: the mesh with other positions. */
class SMG_EXPORT DeformJob : public SolvingJob
{
public:
  DeformJob() { this->name = "handles"; }

  DeformationDescription
    description; ///< its weights, cycles and tolerance are those of `deforming`
  DeformOptions deforming;
  MovedNormals normals = MovedNormals::Recompute;

  using SolvingJob::options;
  SolveOptions& options() override { return this->deforming; }
  std::span<const JobOption> table() const override;
  void check() const override;
  std::string resultHelp() const override;
  std::string resultColumns() const override { return {}; }
  std::vector<ColumnSpec> solutionColumns(const StreamInfo& info) const override;
  void checkOn(const StreamInfo& info) const override;
  Costs costsOn(const StreamInfo& info) const override;
  AddedValues addedTo(const StreamInfo& /*info*/) const override { return { {}, {}, true }; }
  std::unique_ptr<Solution> solveOn(
    const StoredMesh& mesh, const ProgressFunction& progress) override;
  void passResult(const StoredMesh& mesh, Solution& positions, const Reader& read, Report& report,
    const ProgressFunction& progress) const override;

protected:
  bool keeps(const ColumnSpec& column, const StreamInfo& info) const override;

private:
  std::vector<std::string> Notes; ///< on the handles
};

} // namespace smg
