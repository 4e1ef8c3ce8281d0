// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/Filters/LooseMesh.h"
#include "Testing/Filters/PoissonFixture.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/VsmReader.h"

#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>

namespace smg::testing
{
namespace
{

TEST_F(VtkStreamingPoisson, ServesAnyPieceOfTheSameSolution)
{
  const PieceUnion whole = this->collectPieces(1);
  whole.expectEqual(this->Mesh);
  ASSERT_EQ(whole.values.size(), std::size_t(this->Mesh.vertices()));
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  const int executions = this->Ends->Executions;
  // The requested piece before and after the five to solve on.
  EXPECT_EQ(executions, 7);
  for (const int pieces : { 2, 7, 64 })
  {
    const PieceUnion parts = this->collectPieces(pieces);
    parts.expectEqual(this->Mesh);
    EXPECT_EQ(parts.values, whole.values);
  }
  // Only the requested pieces were pulled again.
  EXPECT_EQ(this->Ends->Executions, executions + 2 + 7 + 64);
  for (const auto& [id, value] : whole.values)
  {
    const double* point = &this->Mesh.positions[3 * id];
    if (this->Ends->isHeld(point))
    {
      EXPECT_EQ(value, std::vector<double>(point, point + 3));
    }
    EXPECT_LE(std::abs(value[0]), 3.0 + 1e-6);
  }
}

TEST_F(VtkStreamingPoisson, PointsOfNoCellHaveNoSolution)
{
  const IsolatedVertices loose = writtenAtLoosePoints(this->Folder, *this->Reader, *this->Poisson);
  const auto solution = std::ranges::find(
    loose.columns, "Solution", [](const Column& column) { return column.spec.name; });
  ASSERT_NE(solution, loose.columns.end());
  EXPECT_TRUE(std::isnan(solution->value(0)) && std::isnan(solution->value(1)));
}

TEST_F(VtkStreamingPoisson, NumberOfPiecesAndInCoreDoNotMatter)
{
  const PieceUnion first = this->collectPieces(3);
  this->Poisson->SetNumberOfPieces(1);
  EXPECT_EQ(this->collectPieces(3).values, first.values);
  this->Poisson->SetNumberOfPieces(64);
  EXPECT_EQ(this->collectPieces(3).values, first.values);
  this->Poisson->SetInCore(true);
  EXPECT_EQ(this->collectPieces(3).values, first.values);
}

TEST_F(VtkStreamingPoisson, PreviewCarriesTheTrueSolutionIfThatIsWanted)
{
  const PieceUnion whole = this->collectPieces(1);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  vtkPointSet* preview = this->output();
  ASSERT_TRUE(preview->GetFieldData()->GetArray("Preview"));
  ASSERT_LE(preview->GetNumberOfPoints(), 300);
  auto* ids = preview->GetPointData()->GetGlobalIds();
  auto* solution = preview->GetPointData()->GetArray("Solution");
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
    EXPECT_EQ(solution->GetComponent(i, 2), whole.values.at(id)[2]);
  }
}

/** At once, and the report says that it is a solution on the preview. */
TEST_F(VtkStreamingPoisson, SolvesOnAPreviewInItsPlace)
{
  const PieceUnion whole = this->collectPieces(1);
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(1200);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  const int executions = this->Ends->Executions;
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  EXPECT_EQ(this->Ends->Executions, executions + 1);
  EXPECT_NE(
    std::string(this->Poisson->GetReport()).find("solution on the preview"), std::string::npos);
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  EXPECT_EQ(std::string(this->Poisson->GetOutcome())
              .find("On the preview only: 1,200 of 1,800 points, the result on "),
    0U)
    << this->Poisson->GetOutcome();
  vtkPointSet* preview = this->output();
  auto* ids = preview->GetPointData()->GetGlobalIds();
  auto* solution = preview->GetPointData()->GetArray("Solution");
  double worst = 0.0;
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const std::vector<double>& exact =
      whole.values.at(static_cast<std::int64_t>(ids->GetTuple1(i)));
    worst = std::max(worst, std::fabs(solution->GetComponent(i, 0) - exact[0]));
  }
  // Of a range of 5; more than rounding, since the preview is another mesh.
  EXPECT_LT(worst, 0.5);
  EXPECT_GT(worst, 1e-6);

  // The stream delivers the solution on the mesh.
  ASSERT_TRUE(streamPiece(this->Poisson, 0, 1));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), this->Mesh.vertices());
  for (vtkIdType i = 0; i < this->Mesh.vertices(); ++i)
  {
    ASSERT_EQ(this->output()->GetPointData()->GetArray("Solution")->GetComponent(i, 0),
      whole.values.at(i)[0]);
  }
}

TEST_F(VtkStreamingPoisson, SolvesAgainOnlyAfterAChange)
{
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 7);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 7);
  this->Ends->Modified();
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 14);
  this->Poisson->SetWeights(vtkStreamingPoisson::UNIFORM);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  // The input still has the requested piece.
  EXPECT_EQ(this->Ends->Executions, 20);
}

TEST_F(VtkStreamingPoisson, ReportStandsInTheFieldData)
{
  this->Poisson->SetResultArrayName("Field");
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  auto* report =
    vtkStringArray::SafeDownCast(this->output()->GetFieldData()->GetAbstractArray("Report"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->GetValue(0), this->Poisson->GetReport());
  EXPECT_NE(report->GetValue(0).find("\"vertices\": 1800"), std::string::npos);
  EXPECT_TRUE(this->output()->GetPointData()->HasArray("Field"));
  EXPECT_GT(this->Poisson->GetCycles(), 0);
}

TEST_F(VtkStreamingPoisson, CanBeStreamedItself)
{
  const PieceUnion whole = this->collectPieces(1);
  this->Reader->SetMaximumPointsInMemory(100);
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Poisson->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  writer->SetNumberOfStreamedPieces(9);
  ASSERT_TRUE(writer->Write());
  VsmReader reader(this->Folder / "out.vsm");
  Column solution;
  reader.readVertexColumn("Solution", 0, this->Mesh.vertices(), solution);
  for (std::int64_t i = 0; i < this->Mesh.vertices(); ++i)
  {
    EXPECT_EQ(solution.value(i, 1), whole.values.at(i)[1]);
  }
}

TEST_F(VtkStreamingPoisson, LeavesNoScratchFiles)
{
  {
    vtkNew<vtkStreamingPoisson> poisson;
    this->prepare(poisson);
    ASSERT_TRUE(updatePiece(poisson, 0, 1));
  }
  EXPECT_EQ(this->Folder.entries(), 1);
}

TEST_F(VtkStreamingPoisson, SolvesOnTetrahedra)
{
  this->open(tetBox(12, 7, 6, 0.1));
  this->Ends->Left = 0.5;
  this->Ends->Right = 10.5;
  const PieceUnion whole = this->collectPieces(1);
  whole.expectEqual(this->Mesh);
  EXPECT_TRUE(this->output()->IsA("vtkUnstructuredGrid"));
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  for (const int pieces : { 2, 7, 64 })
  {
    const PieceUnion parts = this->collectPieces(pieces);
    parts.expectEqual(this->Mesh);
    EXPECT_EQ(parts.values, whole.values);
  }
  for (const auto& [id, value] : whole.values)
  {
    const double* point = &this->Mesh.positions[3 * id];
    if (this->Ends->isHeld(point))
    {
      EXPECT_EQ(value, std::vector<double>(point, point + 3));
    }
  }
}

TEST_F(VtkStreamingPoisson, MeshGivenDirectlyStaysWhole)
{
  ASSERT_TRUE(updatePiece(this->Ends, 0, 1));
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(this->Ends->GetOutputDataObject(0));
  const PieceUnion solved = this->collectPieces(1);
  this->Poisson->SetInputDataObject(mesh);
  Errors errors(this->Poisson);
  this->Poisson->SetNumberOfPieces(4);
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("same data for every piece")) << errors.text();
  EXPECT_EQ(mesh->GetNumberOfPoints(), this->Mesh.vertices());
  this->Poisson->SetNumberOfPieces(1);
  EXPECT_EQ(this->collectPieces(1).values, solved.values);
  EXPECT_EQ(mesh->GetNumberOfPoints(), this->Mesh.vertices());
  EXPECT_EQ(mesh->GetNumberOfCells(), this->Mesh.cells());
}

TEST_F(VtkStreamingPoisson, EveryPointHeldIsNoWork)
{
  this->Ends->Left = this->Ends->Right = 0.0;
  const PieceUnion whole = this->collectPieces(1);
  for (const auto& [id, value] : whole.values)
  {
    const double* point = &this->Mesh.positions[3 * id];
    EXPECT_EQ(value, std::vector<double>(point, point + 3));
  }
  EXPECT_EQ(this->Poisson->GetCycles(), 0);
  EXPECT_NE(this->Poisson->GetReport(), std::string());
}

TEST_F(VtkStreamingPoisson, WeightsAreThoseThatAreChosen)
{
  this->open(tetBox(12, 7, 6, 0.1));
  this->Ends->Left = 0.5;
  this->Ends->Right = 10.5;
  ArrayProblem problem;
  problem.Columns = 3;
  problem.Value = this->Mesh.positions;
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    problem.Prescribed.push_back(this->Ends->isHeld(&problem.Value[3 * v]) ? 1 : 0);
    std::fill_n(&problem.Value[3 * v], problem.Prescribed.back() ? 0 : 3, 0.0);
  }
  SolveOptions options;
  options.tolerance = 1e-8;
  EXPECT_EQ(this->Poisson->GetWeights(), vtkStreamingPoisson::COTANGENT);
  const std::pair<int, Weights> kinds[] = { { vtkStreamingPoisson::COTANGENT, Weights::Cotangent },
    { vtkStreamingPoisson::CLAMPED, Weights::Clamped },
    { vtkStreamingPoisson::UNIFORM, Weights::Uniform } };
  for (const auto& [weights, expected] : kinds)
  {
    this->Poisson->SetWeights(weights);
    problem.EdgeWeights = expected;
    const Eigen::MatrixXd values = solveMesh(this->Mesh, problem, options).values;
    for (const auto& [id, value] : this->collectPieces(1).values)
    {
      ASSERT_EQ(value[1], values(id, 1)) << weights;
    }
  }
}

TEST_F(VtkStreamingPoisson, CanBeAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* filter, unsigned long, void*, void* done)
    {
      if (*static_cast<double*>(done) > 0.3)
      {
        static_cast<vtkAlgorithm*>(filter)->SetAbortExecute(1);
      }
    });
  const unsigned long observer = this->Poisson->AddObserver(vtkCommand::ProgressEvent, abort);
  Errors silent(this->Poisson);
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_EQ(this->Folder.entries(), 1);
  this->Poisson->RemoveObserver(observer);
  // It tries again only after a change.
  this->Ends->Executions = 0;
  updatePiece(this->Poisson, 0, 1);
  EXPECT_EQ(this->Ends->Executions, 0);
  // The observer was also notified of the end.
  this->Poisson->SetAbortExecute(0);
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), this->Mesh.vertices());
}

TEST_F(VtkStreamingPoisson, PrintsItsProperties)
{
  std::ostringstream text;
  this->Poisson->Print(text);
  for (const char* name :
    { "Weights: cotangent", "Operators: extended", "Sweeps: 2", "NumberOfPieces: 5", "InCore: 0" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

} // namespace
} // namespace smg::testing
