// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/DeformJob.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace smg
{

class InteractiveMesh;

/** A deformation by the handles in the arrays of the pieces. Its values: see DeformedVertices. */
class DeformationTask : public JobTask
{
public:
  /** With its hierarchy in memory, a mesh takes about so much: 0.65 to 1.1 KiB were measured, on
   * surfaces of 35 to 50 thousand points and tetrahedra of 9 thousand. */
  static constexpr std::int64_t BytesInMemory = 1024;

  DeformationTask();

  DeformJob& asked;          ///< the job
  bool needsNormals = false; ///< of the vertices; tetrahedra have none
  /** Keeps the hierarchy of a mesh in memory for the next deformation; that of the filter. */
  InteractiveMesh* interactive = nullptr;
  /** Whether a preview of which handles hold no point is an error; else it stays as it is. */
  bool needsHandles = false;

  void check() const override;
  Costs costs(const StreamInfo& info) const override;
  bool isInMemory() const override { return this->asked.deforming.inCore; }
  SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) override;

protected:
  std::set<std::string> required() const override;
  std::unique_ptr<Solution> run(const StoredMesh& mesh, const ProgressFunction& progress) override;
  void complete(Result& result, const StoredMesh& mesh, const ProgressFunction& progress) override;

private:
  SolveSummary summaryOfUnmoved(vtkPointSet& preview, std::vector<double>& values) const;
};

} // namespace smg
