// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/StreamedTask.h"
#include "smg/Deform.h"

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

class InteractiveMesh;

/** A deformation by the handles in the arrays of the pieces. Its values: see DeformedVertices. */
class DeformationTask : public StreamedTask
{
public:
  /** With its hierarchy in memory, a mesh takes about so much: 0.65 to 1.1 KiB were measured, on
   * surfaces of 35 to 50 thousand points and tetrahedra of 9 thousand. */
  static constexpr std::int64_t BytesInMemory = 1024;

  DeformOptions options;          ///< except for the progress function
  bool needsNormals = false;      ///< of the vertices; tetrahedra have none
  std::vector<std::string> notes; ///< for the report
  /** Keeps the hierarchy of a mesh in memory for the next deformation; that of the filter. */
  InteractiveMesh* interactive = nullptr;
  /** Whether a preview of which handles hold no point is an error; else it stays as it is. */
  bool needsHandles = false;

  void check() const override;
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override;
  bool isInMemory() const override { return this->options.inCore; }
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) override;
  SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) override;

private:
  SolveSummary summaryOfUnmoved(vtkPointSet& preview, std::vector<double>& values) const;
};

} // namespace smg
