// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkPieceStream.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <memory>

namespace smg
{

/** What is to be computed on a mesh that an input delivers in pieces. */
class StreamedTask
{
public:
  virtual ~StreamedTask() = default;

  /** Throws Error about what is wrong whatever the mesh is, so that it is not pulled in vain. */
  virtual void check() const = 0;

  /** The arrays of the pieces that the task needs. */
  virtual PieceColumns columns() const = 0;

  /**
   * Computes on the whole mesh, which has these columns; nothing of `mesh` is needed afterwards.
   * `report` gets the solution's report and what else there is to say. Throws Error and Cancelled.
   */
  virtual std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress, Report& report) const = 0;
};

} // namespace smg
