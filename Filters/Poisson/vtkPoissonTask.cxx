// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkPoissonTask.h"

#include "Solver/Core/Error.h"
#include "Solver/Description/DescribedProblem.h"

#include <algorithm>
#include <cmath>

namespace smg
{

void PoissonTask::check() const
{
  if (this->arrays.mask.empty() != this->arrays.values.empty())
  {
    throw Error("A Dirichlet mask and Dirichlet values belong together: choose both arrays, or "
                "neither.");
  }
  if (this->arrays.values.empty() && this->arrays.source.empty() && this->arrays.guess.empty())
  {
    throw Error("No array says what to solve: choose a Dirichlet mask with values, or a source.");
  }
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

ProblemDescription PoissonTask::describe(const StreamInfo& mesh) const
{
  ProblemDescription problem;
  problem.weights = this->weights;
  for (const std::string& name : { this->arrays.guess, this->arrays.source, this->arrays.values })
  {
    const auto column = std::ranges::find(mesh.vertexColumns, name, &ColumnSpec::name);
    problem.columns = column == mesh.vertexColumns.end() ? problem.columns : column->components;
  }
  problem.screening = this->screening;
  if (!this->arrays.mask.empty())
  {
    problem.dirichlet = { { ColumnMask{ this->arrays.mask }, this->arrays.values } };
  }
  if (!this->arrays.source.empty())
  {
    problem.source = this->arrays.source;
  }
  if (!this->arrays.guess.empty())
  {
    problem.initial = this->arrays.guess;
  }
  return problem;
}

std::unique_ptr<Solution> PoissonTask::solve(
  const VsmReader& mesh, const ProgressFunction& progress) const
{
  DescribedProblem problem(this->describe(mesh.info()), mesh.info());
  SolveOptions options = this->options;
  options.progress = progress;
  return smg::solve(*mesh.source(), problem, options);
}

} // namespace smg
