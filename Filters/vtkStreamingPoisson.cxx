// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"

#include "Filters/vtkSolutionExchange.h"
#include "Filters/vtkStreamedSolve.h"
#include "IO/vtkPieceInput.h"
#include "IO/vtkPieceStream.h"
#include "IO/vtkStreamingMeshKeys.h"
#include "Solver/Core/Error.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

using vtkSDDP = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkStreamingPoisson);
vtkCxxSetObjectMacro(vtkStreamingPoisson, Controller, vtkMultiProcessController);

namespace
{

/** A request for a piece of the output. */
struct PieceRequest
{
  explicit PieceRequest(vtkInformation* info)
    : Piece(info->Get(vtkSDDP::UPDATE_PIECE_NUMBER()))
    , Pieces(std::max(1, info->Get(vtkSDDP::UPDATE_NUMBER_OF_PIECES())))
    , IsStreamed(vtkStreamingMeshKeys::IsStreamed(info))
  {
  }
  int Piece;
  int Pieces;
  bool IsStreamed;
};

void setRequest(vtkInformation* info, int piece, int pieces, bool isStreamed)
{
  info->Set(vtkSDDP::UPDATE_PIECE_NUMBER(), piece);
  info->Set(vtkSDDP::UPDATE_NUMBER_OF_PIECES(), pieces);
  info->Set(vtkSDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  info->Set(vtkStreamingMeshKeys::STREAMED(), isStreamed ? pieces : 0);
}

/** The time asked for, as far as the input depends on time. */
double timeOf(vtkInformation* input)
{
  const bool hasTime = input->Has(vtkSDDP::TIME_STEPS()) || input->Has(vtkSDDP::TIME_RANGE());
  return hasTime && input->Has(vtkSDDP::UPDATE_TIME_STEP())
           ? input->Get(vtkSDDP::UPDATE_TIME_STEP())
           : 0.0;
}

} // namespace

struct vtkStreamingPoisson::Internals
{
  explicit Internals(vtkStreamingPoisson& self)
    : Self(self)
  {
  }

  /** The name of input array `index`; empty if none is chosen. */
  std::string arrayName(int index) const
  {
    vtkInformation* info = this->Self.GetInputArrayInformation(index);
    const char* name =
      info->Has(vtkDataObject::FIELD_NAME()) ? info->Get(vtkDataObject::FIELD_NAME()) : nullptr;
    if (!name || !*name || std::string(name) == "None")
    {
      return {};
    }
    if (info->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
        info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    {
      throw smg::Error(
        std::string("The array ") + name +
        " is chosen from the cells: a point array is needed; use a filter that turns cell data "
        "into point data.");
    }
    return name;
  }

  smg::StreamedSolveSettings settings() const
  {
    smg::StreamedSolveSettings settings;
    settings.arrays = { .mask = this->arrayName(0),
      .values = this->arrayName(1),
      .source = this->arrayName(2),
      .guess = this->arrayName(3) };
    settings.weights =
      this->Self.Weights == UNIFORM ? smg::Weights::Uniform : smg::Weights::Cotangent;
    settings.screening = this->Self.Screening;
    settings.pieces = this->Self.NumberOfPieces;
    settings.options.operators = this->Self.Operators ? this->Self.Operators : "";
    settings.options.sweeps = this->Self.Sweeps;
    settings.options.tolerance = this->Self.Tolerance;
    settings.options.maxCycles = this->Self.MaximumCycles;
    settings.options.memoryLimit = std::int64_t(this->Self.MemoryLimit) << 20;
    settings.options.threads = this->Self.NumberOfThreads;
    settings.options.scratch = this->Self.ScratchDirectory ? this->Self.ScratchDirectory : "";
    settings.options.inCore = this->Self.InCore;
    return settings;
  }

  smg::StreamedSolve::Stamp stamp(smg::PieceInput& input, vtkInformation* inputInfo) const
  {
    return { this->Self.GetMTime(), input.modifiedTime(), timeOf(inputInfo) };
  }

  void solve(smg::PieceInput& input, vtkInformation* inputInfo)
  {
    smg::Progress progress(
      [this](double done)
      {
        this->Self.UpdateProgress(done);
        return !this->Self.GetAbortExecute();
      });
    try
    {
      this->Solve.solve(input, this->settings(), progress);
    }
    catch (const smg::Error& error)
    {
      this->Solve.fail(error.what());
    }
    // Pulling may have let the pipeline learn of modifications of its own making.
    this->Solve.setStamp(this->stamp(input, inputInfo));
    const smg::SolveSummary& summary = this->Solve.summary();
    if (summary.error.empty() && !summary.converged)
    {
      vtkWarningWithObjectMacro(
        &this->Self, << "The solve did not converge: after " << summary.cycles
                     << " cycles the relative residual is " << summary.residual
                     << "; raise MaximumCycles or Tolerance.");
    }
  }

  /** Shows the results of the solve in the filter's properties. */
  void publish() const
  {
    const smg::SolveSummary& summary = this->Solve.summary();
    this->Self.Residual = summary.residual;
    this->Self.Cycles = summary.cycles;
    this->Self.Passes = summary.passes;
    this->Self.Converged = summary.converged ? 1 : 0;
    this->Self.PeakMemory = static_cast<vtkIdType>(summary.peakMemory);
  }

  /** Brings the input to the piece asked for and gives it to the output with the solution. */
  void answer(smg::PieceInput& input, const PieceRequest& request, smg::SolutionExchange& exchange,
    vtkPointSet& output) const
  {
    vtkPointSet* piece = nullptr;
    std::vector<std::int64_t> ids;
    std::exception_ptr failure;
    try
    {
      piece =
        vtkPointSet::SafeDownCast(input.update(request.Piece, request.Pieces, request.IsStreamed));
      if (piece->GetNumberOfPoints() > 0)
      {
        ids = smg::globalIdsOf(*piece, "The input");
      }
    }
    catch (const std::exception&)
    {
      // The other processes count on this one taking part in the exchange.
      failure = std::current_exception();
      ids.clear();
    }
    const std::vector<double> values =
      exchange.values(ids, this->Solve.summary().columns, this->Solve.solution());
    if (failure)
    {
      std::rethrow_exception(failure);
    }
    this->deliver(output, *piece, values);
  }

  /** Gives the output the input's piece, the solution at its points, and the report. */
  void deliver(vtkPointSet& output, vtkPointSet& piece, const std::vector<double>& values) const
  {
    output.ShallowCopy(&piece);
    vtkNew<vtkDoubleArray> solution;
    solution->SetName(this->Self.ResultArrayName ? this->Self.ResultArrayName : "Solution");
    solution->SetNumberOfComponents(this->Solve.summary().columns);
    solution->SetNumberOfTuples(piece.GetNumberOfPoints());
    std::copy(values.begin(), values.end(), solution->GetPointer(0));
    output.GetPointData()->AddArray(solution);
    vtkNew<vtkStringArray> report;
    report->SetName("Report");
    report->InsertNextValue(this->Solve.summary().report);
    output.GetFieldData()->AddArray(report);
  }

  vtkStreamingPoisson& Self;
  smg::StreamedSolve Solve;
};

vtkStreamingPoisson::vtkStreamingPoisson()
  : Internal(new Internals(*this))
{
  this->SetOperators("extended");
  this->SetResultArrayName("Solution");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkStreamingPoisson::~vtkStreamingPoisson()
{
  this->SetOperators(nullptr);
  this->SetResultArrayName(nullptr);
  this->SetScratchDirectory(nullptr);
  this->SetController(nullptr);
}

const char* vtkStreamingPoisson::GetReport()
{
  return this->Internal->Solve.summary().report.c_str();
}

int vtkStreamingPoisson::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

int vtkStreamingPoisson::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

int vtkStreamingPoisson::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Not the first piece to solve on: were the executive to ask for that, nobody would take the
  // streamed request back if the input failed.
  const PieceRequest request(outputVector->GetInformationObject(0));
  setRequest(
    inputVector[0]->GetInformationObject(0), request.Piece, request.Pieces, request.IsStreamed);
  return 1;
}

int vtkStreamingPoisson::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inputInfo = inputVector[0]->GetInformationObject(0);
  vtkInformation* outputInfo = outputVector->GetInformationObject(0);
  const PieceRequest request(outputInfo);
  try
  {
    smg::PieceInput input(*this, 0);
    // Only process 0 streams: the others are not there to answer.
    smg::SolutionExchange exchange(request.IsStreamed ? nullptr : this->Controller);
    if (request.IsStreamed && !smg::SolutionExchange(this->Controller).isServer())
    {
      throw smg::Error("A streamed request reached a process other than 0, which has no solution: "
                       "stream in process 0.");
    }
    smg::SolveSummary& summary = this->Internal->Solve.summary();
    if (exchange.isServer() &&
        !this->Internal->Solve.isFor(this->Internal->stamp(input, inputInfo)))
    {
      this->Internal->solve(input, inputInfo);
    }
    exchange.share(summary);
    this->Internal->publish();
    if (!summary.error.empty())
    {
      if (this->GetAbortExecute())
      {
        return 0;
      }
      throw smg::Error(summary.error);
    }
    this->Internal->answer(input, request, exchange, *vtkPointSet::GetData(outputInfo));
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkStreamingPoisson::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Weights: " << (this->Weights == UNIFORM ? "uniform" : "cotangent") << "\n";
  os << indent << "Operators: " << (this->Operators ? this->Operators : "(none)") << "\n";
  os << indent << "Sweeps: " << this->Sweeps << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumCycles: " << this->MaximumCycles << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent
     << "ScratchDirectory: " << (this->ScratchDirectory ? this->ScratchDirectory : "(none)")
     << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Screening: " << this->Screening << "\n";
  os << indent << "InCore: " << this->InCore << "\n";
  os << indent << "ResultArrayName: " << (this->ResultArrayName ? this->ResultArrayName : "(none)")
     << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Residual: " << this->Residual << "\n";
  os << indent << "Cycles: " << this->Cycles << "\n";
  os << indent << "Passes: " << this->Passes << "\n";
  os << indent << "PeakMemory: " << this->PeakMemory << "\n";
  os << indent << "Converged: " << this->Converged << "\n";
}
