// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Container/VsmReader.h"
#include "IO/vtkStreamingMeshReader.h"
#include "IO/vtkStreamingMeshWriter.h"
#include "Testing/IO/vtkPieceTesting.h"
#include "Testing/Support/ArrayProblem.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <cmath>

namespace smg::testing
{
namespace
{

/** Makes the point arrays Mask and Values: both ends in x are held at their positions. */
class vtkEndsFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkEndsFilter* New() { VTK_STANDARD_NEW_BODY(vtkEndsFilter); }
  vtkTypeMacro(vtkEndsFilter, vtkPassInputTypeAlgorithm);
  int Executions = 0;
  double Bad = 0.0;
  double Left = -2.5, Right = 2.5;

  bool isHeld(const double* point) const
  {
    return point[0] <= this->Left || point[0] >= this->Right;
  }

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    ++this->Executions;
    vtkPointSet* output = vtkPointSet::GetData(outputVector);
    output->ShallowCopy(vtkPointSet::GetData(inputVector[0]));
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName("Mask");
    vtkNew<vtkDoubleArray> values;
    values->SetName("Values");
    values->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double* point = output->GetPoint(i);
      mask->InsertNextValue(this->isHeld(point) ? 1 : 0);
      values->InsertNextTuple3(point[0] + this->Bad, point[1], point[2]);
    }
    output->GetPointData()->AddArray(mask);
    output->GetPointData()->AddArray(values);
    return 1;
  }
};

class VtkStreamingPoisson : public ::testing::Test
{
protected:
  VtkStreamingPoisson()
  {
    this->open(torus(60, 30, 0.2));
    this->Ends->SetInputConnection(this->Reader->GetOutputPort());
    this->prepare(this->Poisson);
  }

  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
  }

  void prepare(vtkStreamingPoisson* poisson)
  {
    poisson->SetInputConnection(this->Ends->GetOutputPort());
    poisson->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mask");
    poisson->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Values");
    poisson->SetNumberOfPieces(5);
    poisson->SetTolerance(1e-8);
    poisson->SetScratchDirectory(this->Folder.path().c_str());
  }

  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0)); }

  PieceUnion collectPieces(int pieces)
  {
    PieceUnion all;
    all.watched = "Solution";
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Poisson, piece, pieces));
      all.add(this->output(), piece);
    }
    return all;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkEndsFilter> Ends;
  vtkNew<vtkStreamingPoisson> Poisson;
};

TEST_F(VtkStreamingPoisson, ServesAnyPieceOfTheSameSolution)
{
  const PieceUnion whole = this->collectPieces(1);
  whole.expectEqual(this->Mesh);
  ASSERT_EQ(whole.values.size(), std::size_t(this->Mesh.vertices()));
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  const int executions = this->Ends->Executions;
  // The piece that is asked for before and after the five to solve on.
  EXPECT_EQ(executions, 7);
  for (const int pieces : { 2, 7, 64 })
  {
    const PieceUnion parts = this->collectPieces(pieces);
    parts.expectEqual(this->Mesh);
    EXPECT_EQ(parts.values, whole.values);
  }
  // Nothing was pulled again but the pieces that were asked for.
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

TEST_F(VtkStreamingPoisson, PreviewCarriesTheTrueSolution)
{
  const PieceUnion whole = this->collectPieces(1);
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
  // The input still has the piece that is asked for.
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

TEST_F(VtkStreamingPoisson, ErrorsNameTheArray)
{
  Errors errors(this->Poisson);
  this->Poisson->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Nonsense");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("Nonsense")) << errors.text();
  errors.clear();
  this->Poisson->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("belong together")) << errors.text();
  errors.clear();
  this->Poisson->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Values");
  this->Ends->Bad = std::nan("");
  this->Ends->Modified();
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("Values")) << errors.text();
  EXPECT_TRUE(errors.contain("must be finite")) << errors.text();
  this->Ends->Bad = 0.0;
  this->Ends->Modified();
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
}

TEST_F(VtkStreamingPoisson, FailureOfAPieceIsAnError)
{
  vtkNew<vtkFaultyFilter> faulty;
  faulty->SetInputConnection(this->Ends->GetOutputPort());
  this->Poisson->SetInputConnection(faulty->GetOutputPort());
  Errors errors(this->Poisson);
  errors.watch(faulty);
  for (const int piece : { 0, 3, 4 })
  {
    faulty->FailAtPiece = piece;
    faulty->Modified();
    EXPECT_FALSE(updatePiece(this->Poisson, 0, 1)) << piece;
  }
  faulty->FailAtPiece = -1;
  faulty->Modified();
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
}

TEST_F(VtkStreamingPoisson, FailureEndsStreaming)
{
  this->Reader->SetMaximumPointsInMemory(10);
  vtkNew<vtkFaultyFilter> faulty;
  faulty->SetInputConnection(this->Reader->GetOutputPort());
  this->Ends->SetInputConnection(faulty->GetOutputPort());
  Errors errors(this->Poisson);
  errors.watch(faulty);
  const auto expectPreview = [this]
  {
    ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
    EXPECT_TRUE(this->Reader->GetOutputDataObject(0)->GetFieldData()->HasArray("Preview"));
  };
  // The input fails, what it gives is refused, and the solve fails.
  this->Poisson->SetNumberOfPieces(1);
  faulty->FailAtPiece = 0;
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  expectPreview();
  faulty->FailAtPiece = -1;
  faulty->RemoveArray = "GlobalIds";
  faulty->Modified();
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  expectPreview();
  faulty->RemoveArray.clear();
  faulty->Modified();
  this->Poisson->SetScratchDirectory("/no/such/folder");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  expectPreview();
  this->Poisson->SetScratchDirectory(this->Folder.path().c_str());
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
  expectPreview();

  // The same when the filter is itself streamed from.
  faulty->FailAtPiece = 0;
  faulty->Modified();
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Poisson->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  writer->SetNumberOfStreamedPieces(1);
  errors.watch(writer);
  EXPECT_FALSE(writer->Write());
  expectPreview();
  faulty->FailAtPiece = -1;
  faulty->Modified();
  EXPECT_TRUE(writer->Write());
  expectPreview();
}

TEST_F(VtkStreamingPoisson, WhatIsWrongFromTheStartIsToldBeforePulling)
{
  vtkNew<vtkFaultyFilter> passing;
  passing->SetInputConnection(this->Ends->GetOutputPort());
  this->Poisson->SetInputConnection(passing->GetOutputPort());
  Errors errors(this->Poisson);
  const auto expectError = [&](const std::string& words)
  {
    errors.clear();
    passing->Requests.clear();
    EXPECT_FALSE(updatePiece(this->Poisson, 0, 3));
    EXPECT_TRUE(errors.contain(words)) << errors.text();
    EXPECT_LE(passing->Requests.size(), 1U);
  };
  this->Poisson->SetOperators("nonsense");
  expectError("no operator set 'nonsense'");
  this->Poisson->SetOperators("extended");
  for (const double tolerance : { 0.0, 1.0, std::nan("") })
  {
    this->Poisson->SetTolerance(tolerance);
    expectError("between 0 and 1");
  }
  this->Poisson->SetTolerance(1e-6);
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  this->Poisson->SetInputArrayToProcess(1, 0, 0, points, "");
  expectError("belong together");
  this->Poisson->SetInputArrayToProcess(0, 0, 0, points, "");
  expectError("No array says what to solve");
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

TEST_F(VtkStreamingPoisson, ComponentsMustAgree)
{
  Errors errors(this->Poisson);
  this->Poisson->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mask");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("source: the components of the column 'Mask' are 1, but must have 3"))
    << errors.text();
}

TEST_F(VtkStreamingPoisson, NotConvergingIsAWarning)
{
  Errors errors(this->Poisson);
  this->Poisson->SetMaximumCycles(1);
  this->Poisson->SetTolerance(1e-14);
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("did not converge")) << errors.text();
  EXPECT_EQ(this->Poisson->GetConverged(), 0);
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
  // Only a change makes it try again.
  this->Ends->Executions = 0;
  updatePiece(this->Poisson, 0, 1);
  EXPECT_EQ(this->Ends->Executions, 0);
  // The observer was also told of the end.
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
