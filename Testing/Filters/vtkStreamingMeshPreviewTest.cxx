// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshPreview.h"
#include "Filters/vtkStreamingMeshDeformation.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/Filters/vtkEndHandles.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/WriteMesh.h"

#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshPreview : public ::testing::Test
{
protected:
  VtkStreamingMeshPreview()
  {
    this->open(torus(120, 60, 0.2));
    this->Passing->SetInputConnection(this->Reader->GetOutputPort());
    this->Preview->SetInputConnection(this->Passing->GetOutputPort());
    this->Preview->SetPreviewPoints(1000);
    this->Preview->SetNumberOfPieces(5);
  }

  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->Modified(); // the name may be the same
  }

  /** Every point is a vertex of the mesh with its values; no triangle has a point twice. */
  void expectPartOfTheMesh(vtkPolyData* preview) const
  {
    auto* ids = preview->GetPointData()->GetGlobalIds();
    auto* original = preview->GetPointData()->GetArray("OriginalId");
    auto* colours = preview->GetPointData()->GetArray("Colours");
    ASSERT_TRUE(ids && original && colours);
    for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
    {
      const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
      const double* point = preview->GetPoint(i);
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_EQ(point[k], this->Mesh.positions[3 * id + k]);
      }
      ASSERT_EQ(original->GetTuple1(i), double(this->Mesh.originalIds[id]));
      ASSERT_EQ(colours->GetComponent(i, 0), double(float(id) / 3.0F));
    }
    for (vtkIdType c = 0; c < preview->GetNumberOfCells(); ++c)
    {
      vtkCell* cell = preview->GetCell(c);
      ASSERT_EQ(cell->GetNumberOfPoints(), 3);
      EXPECT_NE(cell->GetPointId(0), cell->GetPointId(1));
      EXPECT_NE(cell->GetPointId(1), cell->GetPointId(2));
      EXPECT_NE(cell->GetPointId(2), cell->GetPointId(0));
    }
  }

  double fieldValue(const char* name)
  {
    vtkDataArray* array = this->Preview->GetOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetTuple1(0) : -1.0;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkFaultyFilter> Passing;
  vtkNew<vtkStreamingMeshPreview> Preview;
};

TEST_F(VtkStreamingMeshPreview, IsACoarseMeshOfTheMeshsOwnVertices)
{
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  vtkPolyData* preview = this->Preview->GetOutput();
  EXPECT_LE(preview->GetNumberOfPoints(), 1000);
  EXPECT_GE(preview->GetNumberOfPoints(), 200);
  EXPECT_GT(preview->GetNumberOfCells(), preview->GetNumberOfPoints());
  this->expectPartOfTheMesh(preview);
  EXPECT_EQ(this->fieldValue("Preview"), 1.0);
  EXPECT_EQ(this->fieldValue("FullNumberOfPoints"), double(this->Mesh.vertices()));
  EXPECT_EQ(this->fieldValue("FullNumberOfCells"), double(this->Mesh.cells()));
  double bounds[6];
  preview->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], -3.0, 0.3);
  EXPECT_NEAR(bounds[1], 3.0, 0.3);
  EXPECT_NEAR(bounds[5], 1.0, 0.3);
}

TEST_F(VtkStreamingMeshPreview, PullsEachPieceOnce)
{
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_EQ(this->Passing->Requests,
    (std::vector<std::string>{ "0/1", "0/5", "1/5", "2/5", "3/5", "4/5", "0/1" }));
  this->Passing->Requests.clear();
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_TRUE(this->Passing->Requests.empty());
  this->Preview->SetPreviewPoints(500);
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_LE(this->Preview->GetOutput()->GetNumberOfPoints(), 500);
}

TEST_F(VtkStreamingMeshPreview, SeesTheMeshBehindThePreviewOfTheReader)
{
  this->Reader->SetMaximumPointsInMemory(10);
  this->Reader->SetPreviewPoints(50);
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_GE(this->Preview->GetOutput()->GetNumberOfPoints(), 200);
  this->expectPartOfTheMesh(this->Preview->GetOutput());
  // The reader keeps its own preview.
  auto* shown = vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  EXPECT_TRUE(shown->GetFieldData()->HasArray("Preview"));
  EXPECT_LE(shown->GetNumberOfPoints(), 50);
}

TEST_F(VtkStreamingMeshPreview, WarnsThatItShowsNothing)
{
  StreamMesh mesh = toStream(grid(3, 3));
  const std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()), DuplicateCell);
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  MemorySource source(mesh);
  writeMesh(source, this->Folder / "flat.vsm");
  this->Reader->SetFileName((this->Folder / "flat.vsm").c_str());
  Errors warnings(this->Preview);
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_EQ(this->Preview->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_TRUE(warnings.contain("at most 1000 points shows nothing")) << warnings.text();
}

/** The outcome has the notes of `smg preview`. */
TEST_F(VtkStreamingMeshPreview, SaysWhatItDoesNotShow)
{
  const auto isSaid = [this](const std::string& words)
  { return std::string(this->Preview->GetOutcome()).find(words) != std::string::npos; };
  EXPECT_TRUE(isSaid("Not applied yet"));
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_TRUE(isSaid("triangles of 7,200 points and 14,400 cells")) << this->Preview->GetOutcome();
  EXPECT_FALSE(isSaid(";"));
  IndexedTestMesh bodies = sphere(0);
  for (int k = 1; k < 30; ++k)
  {
    bodies = disjointUnion(bodies, sphere(0), { 3.0 * k, 0.0, 0.0 });
  }
  this->open(bodies);
  this->Preview->SetPreviewPoints(100);
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  EXPECT_TRUE(isSaid("bodies too small for so few vertices are left out"))
    << this->Preview->GetOutcome();
  this->Preview->SetPreviewPoints(1);
  Errors errors(this->Preview);
  updatePiece(this->Preview, 0, 1);
  EXPECT_TRUE(isSaid("Failed: ")) << this->Preview->GetOutcome();
}

TEST_F(VtkStreamingMeshPreview, SmallMeshStaysAsItIs)
{
  this->open(sphere(2));
  for (const int pieces : { 1, 2, 7 })
  {
    this->Preview->SetNumberOfPieces(pieces);
    ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
    EXPECT_EQ(this->Preview->GetOutput()->GetNumberOfPoints(), this->Mesh.vertices());
    EXPECT_EQ(this->Preview->GetOutput()->GetNumberOfCells(), this->Mesh.cells());
  }
}

TEST_F(VtkStreamingMeshPreview, ShowsTheSurfaceOfTetrahedra)
{
  this->open(tetBox(9, 9, 9, 0.1));
  ASSERT_TRUE(updatePiece(this->Preview, 0, 1));
  vtkPolyData* preview = this->Preview->GetOutput();
  this->expectPartOfTheMesh(preview);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const double* point = preview->GetPoint(i);
    const double nearest =
      std::min({ point[0], point[1], point[2], 8.0 - point[0], 8.0 - point[1], 8.0 - point[2] });
    EXPECT_LT(nearest, 0.2);
  }
}

TEST_F(VtkStreamingMeshPreview, OtherPiecesAreEmpty)
{
  ASSERT_TRUE(updatePiece(this->Preview, 1, 2));
  EXPECT_EQ(this->Preview->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(this->Preview->GetOutput()->GetPointData()->HasArray("Colours"));
  EXPECT_EQ(this->fieldValue("Preview"), 1.0);
  ASSERT_TRUE(updatePiece(this->Preview, 0, 2));
  EXPECT_GT(this->Preview->GetOutput()->GetNumberOfPoints(), 200);
}

TEST_F(VtkStreamingMeshPreview, IsDeformedInMemory)
{
  vtkNew<vtkEndHandles> handles;
  handles->SetInputConnection(this->Preview->GetOutputPort());
  handles->move({ .translation = { 1.0, 0.0, 0.0 } });
  vtkNew<vtkStreamingMeshDeformation> deformation;
  deformation->SetInputConnection(handles->GetOutputPort());
  deformation->SetInteractivePoints(0);
  ASSERT_TRUE(updatePiece(deformation, 0, 1));
  EXPECT_EQ(deformation->GetNumberOfBuilds(), 1);
  double bounds[6];
  vtkPointSet::SafeDownCast(deformation->GetOutputDataObject(0))->GetBounds(bounds);
  EXPECT_NEAR(bounds[1], 4.0, 0.3);
}

TEST_F(VtkStreamingMeshPreview, IsNotTakenForTheMeshItself)
{
  vtkNew<vtkEndHandles> handles;
  handles->SetInputConnection(this->Preview->GetOutputPort());
  vtkNew<vtkStreamingMeshDeformation> deformation;
  deformation->SetInputConnection(handles->GetOutputPort());
  Errors errors(deformation);
  EXPECT_EQ(streamPiece(deformation, 0, 3), 0);
  EXPECT_TRUE(errors.contain("take away the Streaming Mesh Preview")) << errors.text();
}

TEST_F(VtkStreamingMeshPreview, FailureOfAPieceIsAnError)
{
  Errors errors(this->Preview);
  errors.watch(this->Passing);
  this->Passing->FailAtPiece = 3;
  EXPECT_FALSE(updatePiece(this->Preview, 0, 1));
  EXPECT_TRUE(errors.contain("Piece 3 of 5")) << errors.text();
  this->Passing->FailAtPiece = -1;
  this->Passing->Modified();
  EXPECT_TRUE(updatePiece(this->Preview, 0, 1));
}

} // namespace
} // namespace smg::testing
