// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingSolver.h"

#include "Filters/Regions/RegionArrays.h"
#include "Filters/SolverInternals.h"
#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/SolveEstimate.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/PropertyNames.h"
#include "IO/Vtk/PropertyRange.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkDataObjectTypes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

vtkCxxSetObjectMacro(vtkStreamingSolver, Controller, vtkMultiProcessController);

vtkStreamingSolver::vtkStreamingSolver(const char* job)
  : Options(new smg::JobProperties(job))
  , Job(job)
  , Internal(new Internals(*this))
{
  this->SetNumberOfOutputPorts(NUMBER_OF_OUTPUT_PORTS);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkStreamingSolver::~vtkStreamingSolver()
{
  this->SetController(nullptr);
}

const smg::SolveSummary& vtkStreamingSolver::GetSummary() const
{
  return this->Internal->Summary;
}

const smg::SolveSummary& vtkStreamingSolver::GetPresentSummary() const
{
  static const smg::SolveSummary none;
  // If an upstream filter fails, this one may not be executed.
  return this->Internal->isUpToDate() ? this->GetSummary() : none;
}

double vtkStreamingSolver::GetResidual()
{
  return this->GetPresentSummary().facts.residual();
}

int vtkStreamingSolver::GetPasses()
{
  return this->GetPresentSummary().facts.passes;
}

vtkIdType vtkStreamingSolver::GetPeakMemory()
{
  return static_cast<vtkIdType>(this->GetPresentSummary().facts.pool_bytes_peak);
}

int vtkStreamingSolver::GetConverged()
{
  return this->GetPresentSummary().facts.converged ? 1 : 0;
}

const char* vtkStreamingSolver::GetOutcome()
{
  const smg::SolveSummary& summary = this->GetSummary();
  const smg::SolveSummary& shown = this->Internal->Shown;
  const std::string& error = this->Internal->Failures.error();
  std::string& text = this->Internal->Outcome;
  text = summary.outcome();
  if (!summary.isCancelled && !this->Internal->Failures.isLast(*this))
  {
    text = "Not solved: not applied yet, or a filter before this one failed.";
  }
  else if (summary.error.empty() && !error.empty())
  {
    text = "Not solved: " + error;
  }
  else if (summary.error.empty() && shown.where() != summary.where() && !shown.where().empty())
  {
    text = shown.outcome() + ". Streamed, as for a file: " + text; // the view has not changed
  }
  return text.c_str();
}

const char* vtkStreamingSolver::GetEstimate()
{
  smg::SolveOptions options;
  this->FillOptions(options);
  this->Internal->Estimate = smg::solveEstimate(
    *this,
    [this](vtkPointSet& input)
    {
      this->CheckRanges();
      return this->MakeEstimatedTask(input);
    },
    options);
  this->Internal->Estimate = this->InPanelWords(this->Internal->Estimate);
  return this->Internal->Estimate.c_str();
}

std::string vtkStreamingSolver::InPanelWords(const std::string& text)
{
  return smg::withProperties(text, *this);
}

std::unique_ptr<smg::JobTask> vtkStreamingSolver::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<smg::JobTask>(this->Job);
  this->FillTask(*task, input);
  return task;
}

void vtkStreamingSolver::FillTask(smg::JobTask& task, vtkPointSet& input) const
{
  smg::MeshJob& job = task.job();
  auto* const solving = dynamic_cast<smg::SolvingJob*>(&job);
  smg::SolveOptions unused;
  smg::SolveOptions& options = solving ? solving->options() : unused;
  this->FillOptions(options);
  task.setLimits(options);
  const auto table = job.table();
  if (!options.checkpoint.folder.empty() &&
      std::ranges::find(table, std::string_view("checkpoint"), &smg::JobOption::key) == table.end())
  {
    throw smg::Error(std::string(smg::jobKind(this->Job).verb) +
                     " has no checkpoints: leave CheckpointDirectory empty");
  }
  this->Options->applyTo(job);
  bool isFirst = true;
  for (const smg::JobOption& option : table)
  {
    if (const auto* where = std::get_if<smg::WhereOption>(&option.kind))
    {
      const std::string name = smg::propertyOf(option);
      const std::string& text = this->Options->text(name);
      where->member.set(job, std::exchange(isFirst, false)
                               ? smg::placesOn(input, text.c_str(), name.c_str())
                             : text.empty() ? std::vector<smg::Where>()
                                            : smg::readPlacesText(text, name));
    }
  }
}

std::unique_ptr<smg::JobTask> vtkStreamingSolver::MakeEstimatedTask(vtkPointSet& input)
{
  return this->MakeTask(input);
}

std::unique_ptr<smg::JobTask> vtkStreamingSolver::MakeCoarserTask(vtkPointSet& coarser)
{
  return this->MakeTask(coarser);
}

const char* vtkStreamingSolver::GetNotes()
{
  return this->GetPresentSummary().notes.c_str();
}

const char* vtkStreamingSolver::GetReport()
{
  return this->GetPresentSummary().report.c_str();
}

const char* vtkStreamingSolver::GetError()
{
  return this->Internal->Failures.error().c_str();
}

void vtkStreamingSolver::CheckRanges() const
{
  smg::requireInRange({ { "Solve", this->Solve, AUTOMATIC_SOLVE, ON_FULL_MESH },
    { "Weights", this->Weights, UNIFORM, CLAMPED }, { "MemoryLimit", this->MemoryLimit, 1 },
    { "ScratchLimit", this->ScratchLimit, 0 },
    { "NumberOfPieces", this->NumberOfPieces, 0, smg::PieceCount::Most } });
  this->Options->check();
}

std::string vtkStreamingSolver::UnusedProperty()
{
  return "";
}

void vtkStreamingSolver::FillOptions(smg::SolveOptions& options) const
{
  options.operators = this->Operators;
  options.sweeps = static_cast<int>(this->Options->number("Sweeps"));
  options.tolerance = this->Options->number("Tolerance");
  options.maxCycles = static_cast<int>(this->Options->number("MaximumCycles"));
  options.memoryLimit = std::int64_t(this->MemoryLimit) << 20;
  options.threads = static_cast<int>(this->Options->number("NumberOfThreads"));
  options.scratch = this->ScratchDirectory;
  options.scratchLimit = std::int64_t(this->ScratchLimit) << 20;
  if (!this->CheckpointDirectory.empty())
  {
    // The task replaces both texts, when it knows the mesh.
    options.checkpoint = { this->CheckpointDirectory, "input", "properties" };
  }
}

smg::Weights vtkStreamingSolver::ChosenWeights() const
{
  return this->Weights == UNIFORM   ? smg::Weights::Uniform
         : this->Weights == CLAMPED ? smg::Weights::Clamped
                                    : smg::Weights::Cotangent;
}

bool vtkStreamingSolver::IsForProcesses(vtkPointSet&, bool)
{
  return false;
}

smg::SolveSummary vtkStreamingSolver::SolveInProcesses(
  vtkPointSet&, const std::function<bool(double)>&, std::vector<double>&)
{
  throw smg::Error(
    smg::nameInPipeline(*this) + " does not solve on the pieces of several processes.");
}

bool vtkStreamingSolver::IsForMemory(vtkPointSet& input, bool)
{
  return smg::isPreview(input) && !smg::isSurfaceOfSolid(input) && this->IsForPreview();
}

bool vtkStreamingSolver::IsForPreview()
{
  return this->Internal->isForPreview();
}

vtkSmartPointer<vtkPointSet> vtkStreamingSolver::MeshInMemory(vtkPointSet& input)
{
  return &input;
}

void vtkStreamingSolver::SpreadValues(vtkPointSet&, int, std::vector<double>&) {}

int vtkStreamingSolver::FillInputPortInformation(int, vtkInformation* info)
{
  smg::acceptMeshes(*info);
  return 1;
}

int vtkStreamingSolver::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == MESH)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
  return 1;
}

int vtkStreamingSolver::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkInformation* mesh = outputVector->GetInformationObject(MESH);
  vtkDataObject* present = vtkDataObject::GetData(mesh);
  if (!input)
  {
    return 0;
  }
  if (!present || !present->IsA(input->GetClassName()))
  {
    mesh->Set(
      vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkDataObject>::Take(input->NewInstance()));
  }
  for (int port = PASSES; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* further = outputVector->GetInformationObject(port);
    if (!further->Has(vtkDataObject::DATA_OBJECT()))
    {
      const char* type = this->GetOutputPortInformation(port)->Get(vtkDataObject::DATA_TYPE_NAME());
      further->Set(vtkDataObject::DATA_OBJECT(),
        vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
    }
  }
  return 1;
}

int vtkStreamingSolver::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return smg::offerPieces(*outputVector);
}

int vtkStreamingSolver::RequestUpdateExtent(
  vtkInformation* asked, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // The executive labels all outputs with the piece that is requested of one of them.
  const int port = asked->Get(vtkExecutive::FROM_OUTPUT_PORT());
  if (port > MESH)
  {
    const smg::PieceRequest further(outputVector->GetInformationObject(port));
    further.forwardTo(outputVector->GetInformationObject(MESH));
  }
  // Not the first piece to solve on: if the executive requested that and the input failed, the
  // streamed request would not be reset.
  const smg::PieceRequest request(outputVector->GetInformationObject(0));
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  if (!request.IsStreamed && smg::SolutionExchange(this->Controller).isParallel())
  {
    // If the input failed in one process here, that process would not join the others in
    // RequestData().
    request.forwardEmptyTo(input);
  }
  else
  {
    request.forwardTo(input);
  }
  return 1;
}

int vtkStreamingSolver::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  bool isSolved = false;
  this->Internal->forgetFailure();
  const int answered =
    smg::runRequestData(*this, this->Internal->Failures, inputVector, *outputVector,
      [&]
      {
        vtkInformation* info = outputVector->GetInformationObject(MESH);
        this->Internal->answer(
          smg::PieceRequest(info), inputVector[0]->GetInformationObject(0), info);
        isSolved = true;
      });
  this->FillFurtherOutputs(isSolved ? this->GetSummary() : smg::SolveSummary(), *outputVector);
  smg::fillText(
    isSolved ? this->Internal->Shown : smg::SolveSummary(), *vtkTable::GetData(outputVector, TEXT));
  for (int port = PASSES; !isSolved && port < this->GetNumberOfOutputPorts(); ++port)
  {
    smg::markAsFailed(*vtkDataObject::GetData(outputVector, port));
  }
  return answered;
}

void vtkStreamingSolver::FillFurtherOutputs(
  const smg::SolveSummary& summary, vtkInformationVector& outputVector)
{
  smg::fillPasses(summary, *vtkTable::GetData(&outputVector, PASSES));
}

void vtkStreamingSolver::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  constexpr const char* places[] = { "automatic", "on the preview", "on the full mesh" };
  os << indent << "Solve: " << smg::printedChoice(places, this->Solve) << "\n";
  constexpr const char* names[] = { "uniform", "cotangent", "clamped" };
  os << indent << "Weights: " << smg::printedChoice(names, this->Weights) << "\n";
  os << indent << "Operators: " << smg::textOrNone(this->Operators) << "\n";
  this->Options->print(os, indent);
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "ScratchDirectory: " << smg::textOrNone(this->ScratchDirectory) << "\n";
  os << indent << "ScratchLimit: " << this->ScratchLimit << "\n";
  os << indent << "CheckpointDirectory: " << smg::textOrNone(this->CheckpointDirectory) << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Residual: " << this->GetResidual() << "\n";
  os << indent << "Passes: " << this->GetPasses() << "\n";
  os << indent << "PeakMemory: " << this->GetPeakMemory() << "\n";
  os << indent << "Converged: " << this->GetConverged() << "\n";
  os << indent << "Outcome: " << this->GetOutcome() << "\n";
}
