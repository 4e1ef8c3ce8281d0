// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "IO/Conversion/JobEstimate.h"
#include "IO/Vtk/PieceStream.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

class vtkPointSet;

namespace smg
{

/** A computation on a mesh that an input delivers in pieces or, with its preview or as a whole, in
 * memory. */
class StreamedTask
{
public:
  virtual ~StreamedTask() = default;

  /** Throws Error for problems that do not depend on the mesh, before the mesh is read. */
  virtual void check() const = 0;

  /** The arrays of the pieces that the task needs. */
  virtual PieceColumns columns() const = 0;

  /** What it is expected to cost on a mesh whose counts and span are known. */
  virtual Costs costs(const StreamInfo& info) const = 0;

  /** Whether the costs are those of a computation in memory, without scratch files. */
  virtual bool isInMemory() const { return false; }

  /** The values that its result has besides that mesh. */
  virtual AddedValues added(const StreamInfo& /*info*/) const { return {}; }

  /** Computes on the whole mesh, which has these columns, with scratch files in the folder
   * `scratch`; `mesh` is not needed afterwards. `report` receives the report of the solution with
   * additional notes. Throws Error and Cancelled. */
  virtual std::unique_ptr<Solution> solve(const VsmReader& mesh,
    const std::filesystem::path& scratch, const ProgressFunction& progress, Report& report) = 0;

  /** Computes on a mesh in memory, which has cells, and sets the values at its points. Throws Error
   * and Cancelled. */
  virtual SolveSummary solveInMemory(
    vtkPointSet& mesh, const ProgressFunction& progress, std::vector<double>& values) = 0;
};

/** Makes the task of a filter from what its input delivered last, which may be nothing. */
using TaskOf = std::function<std::unique_ptr<StreamedTask>(vtkPointSet& input)>;

} // namespace smg
