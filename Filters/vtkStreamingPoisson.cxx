// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"

#include "Filters/Conditions/vtkConditionList.h"
#include "Filters/Poisson/vtkChosenArrays.h"
#include "Filters/Poisson/vtkPieceResults.h"
#include "Filters/Poisson/vtkPoissonTask.h"
#include "Filters/Poisson/vtkPreviewSolve.h"
#include "Filters/Regions/vtkWarnOnce.h"
#include "Filters/Streaming/SolveSummary.h"
#include "IO/Problem/ProblemFile.h"
#include "IO/vtkMeshPieceData.h"
#include "Solver/Core/Error.h"
#include "Solver/Description/ComposeDescriptions.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkStreamingPoisson);

struct vtkStreamingPoisson::Internals
{
  explicit Internals(vtkStreamingPoisson& self)
    : Self(self)
    , NoCells(self)
  {
  }

  /** The problem on a mesh of which `input` is a piece or the preview. */
  smg::ProblemDescription describe(vtkPointSet& input) const
  {
    smg::ProblemDescription problem;
    problem.weights = this->Self.ChosenWeights();
    if (this->Self.Conductivity != 1.0)
    {
      problem.conductivity = this->Self.Conductivity;
    }
    if (this->Self.Screening != 0.0)
    {
      problem.screening = this->Self.Screening;
    }
    this->addArrays(input, problem);
    smg::ProblemDescription defaults;
    defaults.weights = problem.weights;
    if (const char* file = this->Self.ProblemFileName; file && *file)
    {
      append(problem, smg::readProblemFile(file, defaults));
      defaults.weights = problem.weights;
    }
    if (const char* text = this->Self.Problem; text && *text)
    {
      append(problem, smg::readProblemText(text, "Problem", defaults));
    }
    smg::applyConditions(input, problem);
    problem.gradientOutput = problem.gradientOutput || this->Self.Gradient;
    problem.fluxOutput = problem.fluxOutput || this->Self.Flux;
    return problem;
  }

  void addArrays(vtkPointSet& input, smg::ProblemDescription& problem) const
  {
    const smg::ChosenArrays arrays(this->Self, input);
    const std::string mask = arrays.ofPoints(DIRICHLET_MASK);
    const std::string values = arrays.ofPoints(DIRICHLET_VALUES);
    if (mask.empty() != values.empty())
    {
      throw smg::Error("A Dirichlet mask and Dirichlet values belong together: choose both arrays, "
                       "or neither.");
    }
    const std::string guess = arrays.ofPoints(INITIAL_GUESS);
    const std::string source = arrays.any(SOURCE);
    for (const std::string& name : { guess, source, values })
    {
      problem.columns = name.empty() ? problem.columns : arrays.components(name, problem.columns);
    }
    if (!mask.empty())
    {
      problem.dirichlet = { { smg::ColumnMask{ mask }, values } };
    }
    if (!source.empty())
    {
      problem.source = source;
    }
    if (!guess.empty())
    {
      problem.initial = guess;
    }
    if (const std::string screening = arrays.any(SCREENING_ARRAY); !screening.empty())
    {
      problem.screening = screening;
    }
    if (const std::string conductivity = arrays.any(CONDUCTIVITY_ARRAY); !conductivity.empty())
    {
      problem.conductivity = conductivity;
    }
    problem.field = arrays.any(FIELD_ARRAY);
  }

  smg::PoissonTask task(vtkPointSet& input) const
  {
    smg::PoissonTask task;
    task.problem = this->describe(input);
    this->Self.FillOptions(task.options);
    task.options.inCore = this->Self.InCore;
    task.options.acceleration = static_cast<smg::AccelerationKind>(this->Self.Acceleration);
    return task;
  }

  /** Adds Gradient and Flux to the output, which is the input with the solution. A preview may lack
   * what they are made of; then it goes without. */
  void addCellResults(vtkPointSet& output, const std::vector<double>& values)
  {
    const smg::ProblemDescription problem = this->describe(output);
    if (!smg::isPreview(output))
    {
      smg::addCellResults(output, problem, values);
      return;
    }
    if (!problem.gradientOutput && !problem.fluxOutput)
    {
      return;
    }
    try
    {
      if (!vtkPolyData::SafeDownCast(&output))
      {
        throw smg::Error("the preview of a solid has none of its cells.");
      }
      smg::addCellResults(output, problem, values);
      this->NoCells.forget();
    }
    catch (const smg::Error& error)
    {
      this->NoCells.warn(
        "What is saved has Gradient and Flux, but the preview does not show them: " +
        std::string(error.what()));
    }
  }

  vtkStreamingPoisson& Self;
  smg::WarnOnce NoCells;
};

vtkStreamingPoisson::vtkStreamingPoisson()
  : Internal(new Internals(*this))
{
  this->SetResultArrayName("Solution");
}

vtkStreamingPoisson::~vtkStreamingPoisson()
{
  this->SetResultArrayName(nullptr);
  this->SetProblemFileName(nullptr);
  this->SetProblem(nullptr);
}

int vtkStreamingPoisson::GetCycles()
{
  return this->GetSummary().cycles;
}

std::unique_ptr<smg::StreamedTask> vtkStreamingPoisson::MakeTask(vtkPointSet& input)
{
  return std::make_unique<smg::PoissonTask>(this->Internal->task(input));
}

bool vtkStreamingPoisson::IsForMemory(vtkPointSet& input, bool)
{
  if (this->SolveFullMesh || !smg::isPreview(input))
  {
    return false;
  }
  try
  {
    return smg::isPosedOn(input, this->Internal->describe(input));
  }
  catch (const smg::Error&)
  {
    return false; // what is wrong is told where the mesh is to be solved on
  }
}

smg::SolveSummary vtkStreamingPoisson::SolveInMemory(
  vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  smg::PoissonTask task = this->Internal->task(input);
  task.options.progress = progress;
  return smg::solveOnPreview(input, task, values);
}

void vtkStreamingPoisson::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  vtkNew<vtkDoubleArray> solution;
  solution->SetName(this->ResultArrayName ? this->ResultArrayName : "Solution");
  solution->SetNumberOfComponents(this->GetSummary().columns);
  solution->SetNumberOfTuples(piece.GetNumberOfPoints());
  std::copy(values.begin(), values.end(), solution->GetPointer(0));
  output.GetPointData()->AddArray(solution);
  output.GetPointData()->SetActiveScalars(solution->GetName());
  if (piece.GetNumberOfCells() > 0)
  {
    this->Internal->addCellResults(output, values);
  }
  smg::removeConditions(output);
}

void vtkStreamingPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto text = [](const char* string) { return string && *string ? string : "(none)"; };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Conductivity: " << this->Conductivity << "\n";
  os << indent << "Screening: " << this->Screening << "\n";
  os << indent << "ProblemFileName: " << text(this->ProblemFileName) << "\n";
  os << indent << "Problem: " << text(this->Problem) << "\n";
  os << indent << "Gradient: " << this->Gradient << "\n";
  os << indent << "Flux: " << this->Flux << "\n";
  os << indent << "Acceleration: " << this->Acceleration << "\n";
  os << indent << "InCore: " << this->InCore << "\n";
  os << indent << "SolveFullMesh: " << this->SolveFullMesh << "\n";
  os << indent << "ResultArrayName: " << text(this->ResultArrayName) << "\n";
  os << indent << "Cycles: " << this->GetSummary().cycles << "\n";
}
