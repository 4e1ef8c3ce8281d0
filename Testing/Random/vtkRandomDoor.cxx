// SPDX-License-Identifier: BSD-3-Clause
// The door of VTK: a .vsm file is read in pieces, solved by the filter, and its result pulled in as
// many pieces.
#include "Testing/Random/Doors.h"

#include "Filters/vtkStreamingPoisson.h"
#include "IO/vtkFailures.h"
#include "IO/vtkStreamingMeshReader.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

namespace smg::testing
{
namespace
{

/** Collects the errors of an algorithm. */
void collectErrors(vtkAlgorithm* algorithm, std::string& to)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&to);
  command->SetCallback([](vtkObject*, unsigned long, void* text, void* data)
    { *static_cast<std::string*>(text) += static_cast<const char*>(data); });
  algorithm->AddObserver(vtkCommand::ErrorEvent, command);
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, command);
}

vtkPointSet* pieceOf(vtkAlgorithm* algorithm, int piece, int pieces)
{
  vtkNew<vtkInformation> request;
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  vtkNew<vtkInformationVector> requests;
  requests->Append(request);
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(algorithm->GetExecutive());
  const bool isDone = executive->Update(0, requests) != 0;
  vtkDataObject* output = algorithm->GetOutputDataObject(0);
  return isDone && !isFailed(output) ? vtkPointSet::SafeDownCast(output) : nullptr;
}

Result solvePieces(const Case& given)
{
  const TemporaryFolder folder;
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(convertedFile(given, folder.path()).c_str());
  vtkNew<vtkStreamingPoisson> poisson;
  std::string errors;
  collectErrors(reader, errors);
  collectErrors(poisson, errors);
  poisson->SetInputConnection(reader->GetOutputPort());
  // The filter refuses fluxes where a cell does not know its conductivity by itself.
  nlohmann::json problem = given.problem;
  problem.erase("outputs");
  poisson->SetProblem(problem.dump().c_str());
  poisson->SetNumberOfPieces(given.run.pieces);
  poisson->SetNumberOfThreads(given.run.threads);
  poisson->SetSweeps(given.run.sweeps);
  poisson->SetAcceleration(given.run.acceleration);
  poisson->SetInCore(given.run.inCore);
  poisson->SetTolerance(1e-11);
  poisson->SetMaximumCycles(400);
  poisson->SetScratchDirectory(folder.path().c_str());
  Result found{ Eigen::MatrixXd::Zero(given.vertices(), given.problem.value("columns", 1)), {} };
  for (int piece = 0; piece < given.run.pieces; ++piece)
  {
    vtkPointSet* mesh = pieceOf(poisson, piece, given.run.pieces);
    if (!mesh)
    {
      throw Error(errors);
    }
    vtkDataArray* solution = mesh->GetPointData()->GetArray("Solution");
    vtkDataArray* ids = mesh->GetPointData()->GetArray("OriginalId");
    ids = ids ? ids : mesh->GetPointData()->GetGlobalIds();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const auto v = static_cast<std::int64_t>(ids->GetComponent(i, 0));
      for (int k = 0; k < solution->GetNumberOfComponents() && v < given.vertices(); ++k)
      {
        found.values(v, k) = solution->GetComponent(i, k);
      }
    }
    auto* report = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Report"));
    if (report)
    {
      const auto json = nlohmann::json::parse(report->GetValue(0));
      found.report.converged = json.at("converged");
      found.report.acceleration = json.at("acceleration");
      found.report.notes = json.at("notes").get<std::vector<std::string>>();
    }
  }
  return found;
}

const bool IsDoor = (solveByFilter = solvePieces) != nullptr;

} // namespace
} // namespace smg::testing
