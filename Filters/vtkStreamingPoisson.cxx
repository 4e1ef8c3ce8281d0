// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"

#include "Filters/Pieces/CellParts.h"
#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Processes/DistributedTasks.h"
#include "Filters/RegionChain.h"
#include "Filters/Regions/ConditionNames.h"
#include "Filters/Regions/RegionArrays.h"
#include "Filters/Tasks/PoissonTask.h"
#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/WarnOnce.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceCells.h"
#include "IO/Vtk/PropertyRange.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVariantKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTimeStamp.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

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
    // Weights and right-hand sides that a string does not set keep their values.
    smg::ProblemDescription defaults;
    const auto goOn = [&]
    {
      defaults.weights = problem.weights;
      defaults.columns = problem.columns;
    };
    goOn();
    if (!this->Self.ProblemFileName.empty())
    {
      append(problem, smg::readProblemFile(this->Self.ProblemFileName, defaults));
      goOn();
    }
    if (!this->Self.Problem.empty())
    {
      append(problem, smg::readProblemText(this->Self.Problem, "Problem", defaults));
    }
    smg::requireConditionsAfterJoins(this->Self);
    this->Conditions = smg::applyConditions(input, problem);
    problem.gradientOutput = problem.gradientOutput || this->Self.Gradient;
    problem.fluxOutput = problem.fluxOutput || this->Self.Flux;
    problem.vertexGradientOutput = problem.vertexGradientOutput || this->Self.GradientAtPoints;
    problem.integrals.insert(
      problem.integrals.end(), this->Self.Integrals.begin(), this->Self.Integrals.end());
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
    const smg::DataValue source = arrays.any(SOURCE);
    for (const smg::DataValue& value : { smg::DataValue(guess), source, smg::DataValue(values) })
    {
      problem.columns = value.column()->empty() ? problem.columns
                                                : smg::componentsOf(input, value, problem.columns);
    }
    if (!mask.empty())
    {
      problem.dirichlet = { { smg::ColumnMask{ mask }, values } };
    }
    if (!source.column()->empty())
    {
      problem.source = source;
    }
    if (!guess.empty())
    {
      problem.initial = guess;
    }
    const smg::DataValue screening = arrays.any(SCREENING_ARRAY);
    if (!screening.column()->empty())
    {
      problem.screening = screening;
    }
    const smg::DataValue conductivity = arrays.any(CONDUCTIVITY_ARRAY);
    if (!conductivity.column()->empty())
    {
      problem.conductivity = conductivity;
    }
    problem.field = arrays.named(FIELD_ARRAY); // of the cells
  }

  std::unique_ptr<smg::PoissonTask> task(vtkPointSet& input) const
  {
    auto task = std::make_unique<smg::PoissonTask>();
    task->asked.description = this->describe(input);
    const smg::ChosenArrays arrays(this->Self, input);
    task->values = { arrays.named(INITIAL_GUESS), arrays.any(SOURCE),
      arrays.named(DIRICHLET_VALUES) };
    smg::SolveOptions& options = task->asked.solving;
    this->Self.FillOptions(options);
    options.inCore = this->Self.InCore;
    this->Self.Options->applyTo(task->asked);
    return task;
  }

  /** The problem whose values are delivered with a piece. */
  smg::ProblemDescription delivered(vtkPointSet& piece) const
  {
    smg::ProblemDescription problem = this->Solved ? *this->Solved : this->describe(piece);
    problem.columns = smg::columnsWithoutGradient(problem, this->Self.GetSummary().columns);
    return problem;
  }

  /** Adds Gradient and Flux to the output, unless a preview lacks the data that they need. */
  void addCellResults(vtkPointSet& piece, const smg::ProblemDescription& problem,
    const std::vector<double>& values, vtkPointSet& output)
  {
    if (!problem.gradientOutput && !problem.fluxOutput)
    {
      return;
    }
    if (!smg::isPreview(piece))
    {
      if (smg::lacksStreamNumbering(piece) && !smg::hasSimplices(piece))
      {
        const char* scratch = this->Self.GetScratchDirectory();
        const smg::CellParts parts(piece, scratch ? scratch : "");
        smg::addCellResults(parts.mesh(), problem, values, parts.mesh());
        for (const char* name : { smg::GradientName, smg::FluxName })
        {
          parts.average(name, output);
        }
        return;
      }
      smg::addCellResults(piece, problem, values, output);
      return;
    }
    try
    {
      if (!vtkPolyData::SafeDownCast(&piece))
      {
        throw smg::Error(
          "they are values of the tetrahedra of the solid, which its preview does not "
          "have. Raise MaximumPointsInMemory of the reader to see all of them.");
      }
      smg::addCellResults(piece, problem, values, output);
      this->NoCells.forget();
    }
    catch (const smg::Error& error)
    {
      this->NoCells.warn(
        "What is saved has Gradient and Flux, but the preview does not show them: " +
        std::string(error.what()));
    }
  }

  /** Whether the problem file has changed since. */
  void lookAtFile()
  {
    const std::string& name = this->Self.ProblemFileName;
    std::error_code absent;
    const auto time = !name.empty() ? std::filesystem::last_write_time(name, absent)
                                    : std::filesystem::file_time_type();
    if (time != this->FileTime)
    {
      this->FileTime = time;
      this->FileChanged.Modified();
    }
  }

  const char* resultName() const
  {
    const std::string& name = this->Self.ResultArrayName;
    return name.empty() ? "Solution" : name.c_str();
  }

  vtkStreamingPoisson& Self;
  smg::WarnOnce NoCells;
  /** The problem of the last solve, in the process that solves. */
  std::optional<smg::ProblemDescription> Solved;
  mutable smg::ConditionNames Conditions;   ///< of the last description
  std::string WhyNotOnPreview;              ///< if a preview is shown
  std::filesystem::file_time_type FileTime; ///< of the problem file
  vtkTimeStamp FileChanged;
};

vtkStreamingPoisson::vtkStreamingPoisson()
  : Internal(new Internals(*this))
{
}

vtkStreamingPoisson::~vtkStreamingPoisson() = default;

int vtkStreamingPoisson::GetCycles()
{
  return this->GetPresentSummary().facts.cycles;
}

vtkMTimeType vtkStreamingPoisson::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->FileChanged.GetMTime());
}

int vtkStreamingPoisson::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int port,
  vtkMTimeType* time)
{
  this->Internal->lookAtFile();
  return this->Superclass::ComputePipelineMTime(request, inputVector, outputVector, port, time);
}

void vtkStreamingPoisson::CheckRanges() const
{
  this->Superclass::CheckRanges();
  smg::requireInRealRange(
    { { "Conductivity", this->Conductivity, 0.0, smg::RealPropertyRange::NoLimit, true },
      { "Screening", this->Screening, 0.0 } });
}

std::string vtkStreamingPoisson::InPanelWords(const std::string& text)
{
  return this->Internal->Conditions.in(this->Superclass::InPanelWords(text));
}

std::unique_ptr<smg::JobTask> vtkStreamingPoisson::MakeTask(vtkPointSet& input)
{
  const std::string name = this->Internal->resultName();
  if (smg::isReservedColumn(name) || name == smg::OriginalIdName)
  {
    throw smg::Error("The name " + name +
                     " is that of an array that every piece has: choose another ResultArrayName.");
  }
  std::unique_ptr<smg::PoissonTask> task = this->Internal->task(input);
  if (!this->Internal->WhyNotOnPreview.empty())
  {
    task->notes.push_back("the full mesh was solved on, since the preview does not do: " +
                          this->Internal->WhyNotOnPreview);
  }
  if (input.GetPointData()->HasArray(name.c_str()) && !smg::isOfCondition(input, name))
  {
    task->notes.push_back("the array " + name +
                          " of the input is replaced by the solution: choose another "
                          "ResultArrayName to keep both");
  }
  for (const auto& [isWanted, array] :
    { std::pair(task->asked.description.gradientOutput, smg::GradientName),
      std::pair(task->asked.description.fluxOutput, smg::FluxName) })
  {
    if (isWanted && input.GetCellData()->HasArray(array))
    {
      task->notes.push_back(std::string("the array ") + array +
                            " of the cells of the input is replaced by that of the solution");
    }
  }
  if (!this->GetEngineNote().empty())
  {
    task->notes.push_back(this->GetEngineNote());
  }
  this->Internal->Solved = task->asked.description;
  return task;
}

std::unique_ptr<smg::JobTask> vtkStreamingPoisson::MakeEstimatedTask(vtkPointSet& input)
{
  return this->Internal->task(input);
}

bool vtkStreamingPoisson::IsForMemory(vtkPointSet& input, bool isWhole)
{
  this->Internal->WhyNotOnPreview.clear();
  if (this->Engine == DISTRIBUTED || !this->Superclass::IsForMemory(input, isWhole))
  {
    return false;
  }
  try
  {
    this->Internal->WhyNotOnPreview = smg::whyNotOn(input, *this->Internal->task(input));
    return this->Internal->WhyNotOnPreview.empty();
  }
  catch (const smg::Error&)
  {
    return false; // the solve on the full mesh reports it
  }
}

smg::SolveSummary vtkStreamingPoisson::SolveInProcesses(
  vtkPointSet& piece, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  const auto taskOf = [this](vtkPointSet& sample) { return this->MakeTask(sample); };
  return smg::solveInProcesses(piece, this->GetController(), taskOf, progress, values);
}

std::string vtkStreamingPoisson::WhyStreaming()
{
  return this->InCore ? "it keeps everything in the memory of process 0 (InCore)"
                      : this->Superclass::WhyStreaming();
}

void vtkStreamingPoisson::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  // Before the solution comes, which may have the name of one of their arrays.
  smg::removeConditions(output);
  const smg::ProblemDescription problem = this->Internal->delivered(piece);
  const auto columns = static_cast<std::size_t>(problem.columns);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  const auto add = [&](const char* name, std::size_t first, std::size_t count)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(count));
    array->SetNumberOfTuples(piece.GetNumberOfPoints());
    array->GetInformation()->Set(vtkStreamingMeshKeys::ISOLATED_VALUE(), std::nan(""));
    std::vector<double> numbers(static_cast<std::size_t>(array->GetNumberOfValues()));
    for (std::size_t e = 0; e < numbers.size(); ++e)
    {
      numbers[e] = values[e / count * stride + first + e % count];
    }
    std::ranges::copy(numbers, array->GetPointer(0));
    smg::addResult(*output.GetPointData(), *array);
    return numbers;
  };
  if (problem.vertexGradientOutput)
  {
    add(smg::GradientName, columns, 3 * columns);
  }
  const std::vector<double> solution = add(this->Internal->resultName(), 0, columns);
  output.GetPointData()->SetActiveScalars(this->Internal->resultName());
  if (piece.GetNumberOfCells() > 0)
  {
    this->Internal->addCellResults(piece, problem, solution, output);
  }
}

void vtkStreamingPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Conductivity: " << this->Conductivity << "\n";
  os << indent << "Screening: " << this->Screening << "\n";
  os << indent << "ProblemFileName: " << smg::textOrNone(this->ProblemFileName) << "\n";
  os << indent << "Problem: " << smg::textOrNone(this->Problem) << "\n";
  os << indent << "Gradient: " << this->Gradient << "\n";
  os << indent << "Flux: " << this->Flux << "\n";
  os << indent << "GradientAtPoints: " << this->GradientAtPoints << "\n";
  os << indent << "Integrals: " << this->GetNumberOfIntegrals() << "\n";
  os << indent << "InCore: " << this->InCore << "\n";
  os << indent << "ResultArrayName: " << smg::textOrNone(this->ResultArrayName) << "\n";
  os << indent << "Cycles: " << this->GetSummary().facts.cycles << "\n";
}
