// SPDX-License-Identifier: BSD-3-Clause
// The door of VTK: a .vsm file is read in pieces, solved by the filter, and its result pulled in as
// many pieces.
#include "Testing/Random/FilterDoor.h"

#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceRequest.h"
#include "smg/Error.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

namespace smg::testing
{

FilterResult solveByFilter(const FilterRun& run)
{
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(run.mesh.c_str());
  vtkNew<vtkStreamingPoisson> poisson;
  Errors errors(reader);
  errors.watch(poisson);
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
    if (!updatePiece(poisson, piece, run.pieces))
    {
      throw Error(errors.text());
    }
    auto* mesh = vtkPointSet::SafeDownCast(poisson->GetOutputDataObject(0));
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
