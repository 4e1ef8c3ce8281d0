// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/vtkPieceStream.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <memory>

namespace smg
{

/** A computation on a mesh that an input delivers in pieces. */
class StreamedTask
{
public:
  virtual ~StreamedTask() = default;

  /** Throws Error for problems that do not depend on the mesh, before the mesh is read. */
  virtual void check() const = 0;

  /** The arrays of the pieces that the task needs. */
  virtual PieceColumns columns() const = 0;

  /** Computes on the whole mesh, which has these columns; `mesh` is not needed afterwards. `report`
   * receives the report of the solution with additional notes. Throws Error and Cancelled. */
  virtual std::unique_ptr<Solution> solve(
    const VsmReader& mesh, const ProgressFunction& progress, Report& report) const = 0;
};

} // namespace smg
