// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkStreamedTask.h"
#include "smg/Deform.h"

#include <string>
#include <vector>

namespace smg
{

/** A deformation by the handles in the arrays of the pieces. Its values: see DeformedVertices. */
class DeformationTask : public StreamedTask
{
public:
  DeformOptions options;          ///< except for the progress function
  bool needsNormals = false;      ///< of the vertices; tetrahedra have none
  std::vector<std::string> notes; ///< for the report

  void check() const override;
  PieceColumns columns() const override;
  Costs costs(const StreamInfo& info) const override;
  std::unique_ptr<Solution> solve(const VsmReader& mesh, const std::filesystem::path& scratch,
    const ProgressFunction& progress, Report& report) const override;
};

} // namespace smg
