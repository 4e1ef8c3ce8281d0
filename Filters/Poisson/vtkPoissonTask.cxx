// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkPoissonTask.h"

#include "Solver/Core/Error.h"

#include <algorithm>
#include <cmath>

namespace smg
{

void PoissonTask::check() const
{
  ColumnProblem::check(this->arrays);
  checkOptions(this->options);
  checkOperators(this->options);
  if (!std::isfinite(this->screening))
  {
    throw Error("The screening is not a finite number: use one that is at least 0.");
  }
}

PieceColumns PoissonTask::columns() const
{
  PieceColumns columns;
  for (const std::string& name :
    { this->arrays.mask, this->arrays.values, this->arrays.source, this->arrays.guess })
  {
    if (!name.empty() &&
        std::find(columns.points.begin(), columns.points.end(), name) == columns.points.end())
    {
      columns.points.push_back(name);
    }
  }
  columns.cells.push_back(CellFlagsName);
  return columns;
}

std::unique_ptr<Solution> PoissonTask::solve(
  const VsmReader& mesh, const ProgressFunction& progress) const
{
  ColumnProblem problem(mesh.info(), this->arrays, this->weights, this->screening);
  SolveOptions options = this->options;
  options.progress = progress;
  return smg::solve(*mesh.source(), problem, options);
}

} // namespace smg
