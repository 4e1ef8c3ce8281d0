// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/AbortTesting.h"
#include "Testing/Filters/DeformationFixture.h"
#include "smg/VsmReader.h"

#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <cmath>

namespace smg::testing
{
namespace
{

using VtkStreamingMeshDeformation = DeformationFixture;

TEST_F(VtkStreamingMeshDeformation, EveryWayGivesTheSamePoints)
{
  const StreamMesh expected = this->deformed(this->Mesh);
  EXPECT_NE(expected.positions, this->Mesh.positions);
  // In memory.
  this->collectPieces(1).expectEqual(expected);
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), 1);
  EXPECT_EQ(this->Handles->Executions, 1);
  // Out of core: any number of pieces of one solve.
  this->Deformation->SetInteractivePoints(100);
  for (const int pieces : { 1, 2, 7, 64 })
  {
    this->collectPieces(pieces).expectEqual(expected);
  }
  EXPECT_EQ(this->Handles->Executions, 1 + 5 + 1 + 2 + 7 + 64);
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), 1);
  this->Deformation->SetNumberOfPieces(1);
  this->collectPieces(3).expectEqual(expected);
}

TEST_F(VtkStreamingMeshDeformation, FixedNumberOfCycles)
{
  Errors errors(this->Deformation);
  this->Deformation->SetCycles(2);
  const StreamMesh expected = this->deformed(this->Mesh);
  this->collectPieces(1).expectEqual(expected);
  this->Deformation->SetInteractivePoints(0);
  this->collectPieces(2).expectEqual(expected);
  EXPECT_EQ(this->Deformation->GetPasses(), 5);
  EXPECT_EQ(errors.text(), "");
}

TEST_F(VtkStreamingMeshDeformation, TetrahedraAreDeformed)
{
  this->open(tetBox(12, 7, 6, 0.1));
  this->Handles->Ends.left = 0.5;
  this->Handles->Ends.right = 10.5;
  const StreamMesh expected = this->deformed(this->Mesh);
  this->collectPieces(1).expectEqual(expected);
  EXPECT_TRUE(this->output()->IsA("vtkUnstructuredGrid"));
  this->collectPieces(7).expectEqual(expected);
}

TEST_F(VtkStreamingMeshDeformation, StreamedRequestsGetTheWholeMesh)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  const StreamMesh expected = this->deformed(this->Mesh);
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Deformation->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  writer->SetNumberOfStreamedPieces(9);
  ASSERT_TRUE(writer->Write());
  const VsmReader reader(this->Folder / "out.vsm");
  const auto source = reader.source();
  const StreamMesh written = collect(*source);
  EXPECT_EQ(written.positions, expected.positions);
  EXPECT_EQ(written.corners, expected.corners);
  std::set<std::string> names;
  for (const ColumnSpec& spec : reader.info().vertexColumns)
  {
    names.insert(spec.name);
  }
  EXPECT_EQ(names, (std::set<std::string>{ "OriginalId", "Colours" }));
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), 0);
}

TEST_F(VtkStreamingMeshDeformation, AFinePreviewFollowsACoarserOneThatIsDragged)
{
  constexpr vtkIdType DragPoints = 600;
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(1500);
  this->Deformation->SetDragPoints(DragPoints);
  ASSERT_TRUE(updatePiece(this->Handles, 0, 1));
  const vtkIdType fine =
    vtkPointSet::SafeDownCast(this->Handles->GetOutputDataObject(0))->GetNumberOfPoints();
  ASSERT_GT(fine, 2 * DragPoints);
  const StreamMesh full = this->deformed(this->Mesh);
  for (const double degrees : { 70.0, 20.0, -50.0 })
  {
    HandleMotion::Parameters turn = this->Turn;
    turn.degrees = degrees;
    this->Handles->move(turn);
    ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
    vtkPointSet* shown = this->output();
    EXPECT_EQ(shown->GetNumberOfPoints(), fine);
    EXPECT_TRUE(shown->GetFieldData()->HasArray("Preview"));
    // Its points are points of the mesh, about where the deformation of that has them.
    if (degrees == this->Turn.degrees)
    {
      vtkDataArray* ids = shown->GetPointData()->GetGlobalIds();
      double sum = 0.0;
      for (vtkIdType i = 0; i < shown->GetNumberOfPoints(); ++i)
      {
        const auto id = static_cast<std::size_t>(ids->GetTuple1(i));
        const double* p = shown->GetPoint(i);
        const double* q = full.positions.data() + 3 * id;
        const double off = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        EXPECT_LT(off, 0.5); // of a radius of 3
        sum += off;
      }
      // It says about how far.
      const std::string said = this->Deformation->GetOutcome();
      const std::string before = "a quarter of which differs by ";
      const std::size_t at = said.find(before);
      ASSERT_NE(at, std::string::npos) << said;
      const double mean = std::stod(said.substr(at + before.size()));
      const double truth = sum / static_cast<double>(shown->GetNumberOfPoints());
      EXPECT_LT(truth, 2.0 * mean);
      EXPECT_GT(truth, 0.05 * mean);
    }
  }
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), 1); // kept while only the motion changes
}

TEST_F(VtkStreamingMeshDeformation, PreviewIsDeformedByItselfAndAtOnce)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(1500);
  ASSERT_TRUE(updatePiece(this->Handles, 0, 1));
  auto* preview = vtkPolyData::SafeDownCast(this->Handles->GetOutputDataObject(0));
  ASSERT_TRUE(preview->GetFieldData()->HasArray("Preview"));
  // The preview as a mesh of its own; its points are not numbered by first use.
  IndexedTestMesh indexed;
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const double* point = preview->GetPoint(i);
    indexed.positions.insert(indexed.positions.end(), point, point + 3);
  }
  for (vtkIdType c = 0; c < preview->GetNumberOfCells(); ++c)
  {
    vtkIdList* cell = preview->GetCell(c)->GetPointIds();
    indexed.corners.insert(indexed.corners.end(), cell->begin(), cell->end());
  }
  const StreamMesh mesh = toStream(indexed, TestOrder::Keep);
  for (const double degrees : { 70.0, 20.0, -50.0 })
  {
    HandleMotion::Parameters turn = this->Turn;
    turn.degrees = degrees;
    this->Handles->move(turn);
    ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
    const StreamMesh expected = this->deformed(mesh);
    ASSERT_EQ(this->output()->GetNumberOfPoints(), indexed.vertices());
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      const double* point = this->output()->GetPoint(mesh.originalIds[v]);
      ASSERT_EQ(std::vector<double>(point, point + 3),
        std::vector<double>(&expected.positions[3 * v], &expected.positions[3 * v] + 3));
    }
    EXPECT_TRUE(this->output()->GetFieldData()->HasArray("Preview"));
    EXPECT_TRUE(this->output()->GetPointData()->GetGlobalIds());
    EXPECT_TRUE(
      std::string(this->Deformation->GetNotes()).find("this is the deformed preview, a mesh of ") !=
      std::string::npos)
      << this->Deformation->GetNotes();
    EXPECT_EQ(std::string(this->Deformation->GetOutcome()).find("On the preview only: "), 0u);
  }
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), 1);
  EXPECT_EQ(this->Handles->Executions, 1 + 3);
}

TEST_F(VtkStreamingMeshDeformation, AllOfAPreviewIsInItsFirstPiece)
{
  Errors errors(this->Deformation);
  this->Reader->SetMaximumPointsInMemory(100);
  ASSERT_TRUE(updatePiece(this->Deformation, 1, 2));
  EXPECT_EQ(this->output()->GetNumberOfPoints(), 0);
  ASSERT_TRUE(updatePiece(this->Deformation, 0, 2));
  EXPECT_GT(this->output()->GetNumberOfPoints(), 100);
  const std::string report = this->Deformation->GetReport();
  ASSERT_TRUE(updatePiece(this->Deformation, 1, 2));
  EXPECT_EQ(this->Deformation->GetReport(), report);
  EXPECT_EQ(errors.text(), "");
}

TEST_F(VtkStreamingMeshDeformation, HierarchyIsKeptWhileOnlyTheMotionChanges)
{
  const auto expectBuilds = [this](int builds)
  {
    this->collectPieces(1).expectEqual(this->deformed(this->Mesh));
    EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), builds);
  };
  expectBuilds(1);
  this->Handles->move({ .translation = { 0.0, 0.0, 1.0 } });
  expectBuilds(1);
  this->Handles->CopiesMesh = true;
  this->Handles->move(this->Turn);
  expectBuilds(1);
  this->Handles->Ends.left = -2.0;
  this->Handles->Modified();
  expectBuilds(2);
  this->Deformation->SetCycles(4);
  expectBuilds(3);
  this->open(torus(50, 30, 0.2));
  expectBuilds(4);
  // A mesh of more than InteractivePoints points has none.
  this->Deformation->SetInteractivePoints(0);
  expectBuilds(4);
  this->Deformation->SetInteractivePoints(200000);
  expectBuilds(5);
}

TEST_F(VtkStreamingMeshDeformation, HandlesThatDoNotMoveGiveTheMeshBack)
{
  this->Handles->move({});
  for (const vtkIdType points : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(points);
    const PieceUnion whole = this->collectPieces(1);
    ASSERT_EQ(std::int64_t(whole.points.size()), this->Mesh.vertices());
    for (const auto& [id, point] : whole.points)
    {
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_NEAR(point[k], this->Mesh.positions[3 * id + k], 1e-8);
      }
    }
  }
}

TEST_F(VtkStreamingMeshDeformation, MeshNeedsNoStreamOrderInMemory)
{
  // Points without cells stay, or move to their targets if they are held; no array identifies the
  // vertices of a stream.
  ASSERT_TRUE(updatePiece(this->Handles, 0, 1));
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(this->Handles->GetOutputDataObject(0));
  const vtkIdType count = mesh->GetNumberOfPoints();
  vtkNew<vtkPolyData> loose;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0.0, 8.0, 7.0);
  points->InsertNextPoint(9.0, 8.0, 7.0);
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = count; i-- > 0;)
  {
    points->InsertNextPoint(mesh->GetPoint(i));
  }
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
  {
    cells->InsertNextCell(3);
    for (int k = 0; k < 3; ++k)
    {
      cells->InsertCellPoint(count + 1 - mesh->GetCell(c)->GetPointId(k));
    }
  }
  loose->SetPoints(points);
  loose->SetPolys(cells);
  this->Handles->SetInputDataObject(loose);
  const StreamMesh expected = this->deformed(this->Mesh);
  ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
  const double held[] = { 9.0, 8.0, 7.0 };
  const std::array<double, 3> target = this->Handles->Ends.motion.apply(held);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(this->output()->GetPoint(0)[k], points->GetPoint(0)[k]);
    EXPECT_EQ(this->output()->GetPoint(1)[k], target[k]);
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* point = this->output()->GetPoint(count + 1 - i);
    ASSERT_EQ(point[1], expected.positions[3 * i + 1]);
  }
  EXPECT_NE(
    std::string(this->Deformation->GetReport())
      .find("2 points are corners of no triangle or polygon: those that a handle holds move"),
    std::string::npos);
}

TEST_F(VtkStreamingMeshDeformation, ReportStandsInTheFieldData)
{
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
    auto* report =
      vtkStringArray::SafeDownCast(this->output()->GetFieldData()->GetAbstractArray("Report"));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->GetValue(0), this->Deformation->GetReport());
    EXPECT_NE(report->GetValue(0).find("\"vertices\": 1800"), std::string::npos);
    EXPECT_EQ(this->Deformation->GetConverged(), 1);
  }
}

TEST_F(VtkStreamingMeshDeformation, ErrorsSayWhatToDo)
{
  Errors errors(this->Deformation);
  const auto expectError = [&](const std::string& words)
  {
    this->Handles->Modified();
    for (const vtkIdType interactive : { 200000, 0 })
    {
      errors.clear();
      this->Deformation->SetInteractivePoints(interactive);
      EXPECT_FALSE(updatePiece(this->Deformation, 0, 1));
      EXPECT_TRUE(errors.contain(words)) << errors.text();
    }
  };
  for (const char* name :
    { HandleMaskName, HandleTargetName, HandleRotationName, HandleLogScaleName })
  {
    this->Handles->LeftOut = { name };
    expectError(name);
    EXPECT_TRUE(errors.contain("put a Mesh Handle before")) << errors.text();
  }
  this->Handles->LeftOut.clear();
  this->Handles->TargetComponents = 2;
  expectError("HandleTarget has 2 components instead of 3");
  this->Handles->TargetComponents = 3;
  this->Handles->Ends.bad = std::nan("");
  expectError("the column 'HandleTarget' is not a finite number at vertex 0");
  this->Handles->Ends.bad = 0.0;
  this->Handles->Ends.left = -100.0;
  this->Handles->Ends.right = 100.0;
  expectError("no vertex of the mesh is held by a handle");
  this->Handles->Ends.left = -2.5;
  this->Handles->Modified();
  EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
}

TEST_F(VtkStreamingMeshDeformation, FailureOfAPieceIsAnError)
{
  vtkNew<vtkFaultyFilter> faulty;
  faulty->SetInputConnection(this->Handles->GetOutputPort());
  this->Deformation->SetInputConnection(faulty->GetOutputPort());
  this->Deformation->SetInteractivePoints(0);
  Errors errors(this->Deformation);
  errors.watch(faulty);
  for (const int piece : { 0, 3 })
  {
    faulty->FailAtPiece = piece;
    faulty->Modified();
    EXPECT_FALSE(updatePiece(this->Deformation, 0, 1)) << piece;
  }
  faulty->FailAtPiece = -1;
  faulty->Modified();
  EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
}

TEST_F(VtkStreamingMeshDeformation, CanBeAborted)
{
  expectCanBeAborted(this->Deformation.Get(), this->Folder);
  this->Deformation->SetInteractivePoints(0);
  expectCanBeAborted(this->Deformation.Get(), this->Folder);
}

TEST_F(VtkStreamingMeshDeformation, PrintsItsProperties)
{
  std::ostringstream text;
  this->Deformation->Print(text);
  for (const char* name : { "Weights: clamped", "Cycles: 0", "Normals: recompute",
         "InteractivePoints: 200000", "DragPoints: 10000", "NumberOfBuilds: 0" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

} // namespace
} // namespace smg::testing
