// SPDX-License-Identifier: BSD-3-Clause
// The door of VTK: a .vsm file is read in pieces, solved by the filter, and its result pulled in as
// many pieces.
#include "Testing/Random/FilterDoor.h"

#include "Filters/vtkStreamingPoisson.h"
#include "IO/vtkFailures.h"
#include "IO/vtkStreamingMeshReader.h"
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

} // namespace

FilterResult solveByFilter(const FilterRun& run)
{
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(run.mesh.c_str());
  vtkNew<vtkStreamingPoisson> poisson;
  std::string errors;
  collectErrors(reader, errors);
  collectErrors(poisson, errors);
  poisson->SetInputConnection(reader->GetOutputPort());
  poisson->SetProblem(run.problem.c_str());
  poisson->SetNumberOfPieces(run.pieces);
  poisson->SetNumberOfThreads(run.threads);
  poisson->SetSweeps(run.sweeps);
  poisson->SetAcceleration(run.acceleration);
  poisson->SetInCore(run.inCore);
  poisson->SetTolerance(1e-11);
  poisson->SetMaximumCycles(400);
  poisson->SetScratchDirectory(run.scratch.c_str());
  FilterResult found{ Eigen::MatrixXd::Zero(run.vertices, run.columns), {} };
  for (int piece = 0; piece < run.pieces; ++piece)
  {
    vtkPointSet* mesh = pieceOf(poisson, piece, run.pieces);
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
      for (int k = 0; k < run.columns && v < run.vertices; ++k)
      {
        found.values(v, k) = solution->GetComponent(i, k);
      }
    }
    vtkAbstractArray* report = mesh->GetFieldData()->GetAbstractArray("Report");
    if (auto* text = vtkStringArray::SafeDownCast(report))
    {
      found.report = text->GetValue(0);
    }
  }
  return found;
}

} // namespace smg::testing
