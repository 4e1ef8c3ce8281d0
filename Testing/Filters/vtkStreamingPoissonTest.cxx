// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Container/VsmReader.h"
#include "IO/vtkStreamingMeshReader.h"
#include "IO/vtkStreamingMeshWriter.h"
#include "Testing/IO/vtkPieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <cmath>

namespace smg::testing
{
namespace
{

/** Makes the point arrays Mask and Values: both ends of the x axis are held at their positions. */
class vtkEndsFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkEndsFilter* New() { VTK_STANDARD_NEW_BODY(vtkEndsFilter); }
  vtkTypeMacro(vtkEndsFilter, vtkPassInputTypeAlgorithm);
  int Executions = 0;
  double Bad = 0.0;

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
      mask->InsertNextValue(std::abs(point[0]) > 2.5 ? 1 : 0);
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
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", torus(60, 30, 0.2));
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Ends->SetInputConnection(this->Reader->GetOutputPort());
    this->prepare(this->Poisson);
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
  EXPECT_EQ(executions, 6);
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
    if (std::abs(point[0]) > 2.5)
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
  EXPECT_EQ(this->Ends->Executions, 6);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 6);
  this->Ends->Modified();
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 12);
  this->Poisson->SetWeights(vtkStreamingPoisson::UNIFORM);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 2));
  EXPECT_EQ(this->Ends->Executions, 18);
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
  EXPECT_TRUE(errors.contain("not a finite number")) << errors.text();
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
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
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
