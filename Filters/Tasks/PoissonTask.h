// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/SolveJob.h"
#include "smg/ProblemDescription.h"

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkPointSet;

namespace smg
{

/** A problem whose columns are arrays of the pieces. */
class PoissonTask : public JobTask
{
public:
  PoissonTask();

  SolveJob& asked; ///< the job
  /**
   * Arrays whose number of components is the number of right-hand sides if the problem has fewer.
   */
  std::vector<DataValue> values;

  /** The problem on a mesh with these columns. */
  ProblemDescription description(const StreamInfo& info) const;

  void check() const override;
  Costs costs(const StreamInfo& info) const override;
  AddedValues added(const StreamInfo& info) const override;

protected:
  std::string resultOnPreview() const override { return "this is the solution on the preview"; }
  std::set<std::string> required() const override;
  void prepareFor(const StreamInfo& info) override;
  void complete(Result& result, const StoredMesh& mesh, const ProgressFunction& progress) override;

private:
  int columnsOn(const StreamInfo& info) const;
};

/** The arrays chosen with SetInputArrayToProcess() of a filter; an empty name: none. */
class ChosenArrays
{
public:
  /** Both arguments must outlive the object. */
  ChosenArrays(vtkAlgorithm& filter, vtkPointSet& input)
    : Filter(filter)
    , Input(input)
  {
  }

  /** The name of array `index`, of points or cells. */
  std::string named(int index) const;
  /** Array `index`; throws Error if it was chosen from the cells. */
  std::string ofPoints(int index) const;
  /** Array `index`, of the points or the cells. */
  DataValue any(int index) const;

private:
  vtkAlgorithm& Filter;
  vtkPointSet& Input;
};

/** The columns of the problem, of a solution with this many, which has the gradients at the points
 * if they are wanted. */
int columnsWithoutGradient(const ProblemDescription& problem, int columns);

/** Throws Error if the requested cell results need more than the cell itself. */
void checkCellResults(const ProblemDescription& problem);

/**
 * Adds the requested cell arrays Gradient and Flux to the output, for a piece of a mesh or its
 * preview with the solution `values` at its points. Throws Error if the piece lacks data of the
 * conductivity.
 */
void addCellResults(vtkPointSet& piece, const ProblemDescription& problem,
  std::span<const double> values, vtkPointSet& output);

/**
 * The reason why a task cannot be solved on the preview of a mesh; empty if it can: the preview is
 * that of a surface, the problem has no boundary conditions, since open edges of a preview are
 * longer, and the preview has all arrays that the problem names and a point in each of its regions.
 */
std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task);

} // namespace smg
