// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshHandle.h"
#include "Filters/vtkStreamingMeshDeformation.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkPlane.h"
#include "vtkSphere.h"

#include <Eigen/Dense>

#include <cmath>
#include <string>

namespace smg::testing
{
namespace
{

/** A cube with a fixed floor and a handle inside, which touches no point of the surface. */
class VtkSolidDeformation : public ::testing::Test
{
protected:
  VtkSolidDeformation()
  {
    writeVsm(this->Folder / "cube.vsm", tetBox(24, 24, 24, 0.2));
    this->Reader->SetFileName((this->Folder / "cube.vsm").c_str());
    this->Floor->SetOrigin(0.0, 0.0, 1.5);
    this->Floor->SetNormal(0.0, 0.0, 1.0);
    this->Below->SetInputConnection(this->Reader->GetOutputPort());
    this->Below->SetRegionFunction(this->Floor);
    this->Ball->SetCenter(11.5, 11.5, 13.0);
    this->Ball->SetRadius(4.5);
    this->Inside->SetInputConnection(this->Below->GetOutputPort());
    this->Inside->SetRegionFunction(this->Ball);
    this->Inside->SetMotion(vtkMeshHandle::SIMILARITY);
    this->Inside->SetCenter(11.5, 11.5, 13.0);
    this->Inside->SetRotationAxis(0.0, 0.0, 1.0);
    this->Inside->SetRotationAngle(40.0);
    this->Inside->SetTranslation(5.0, 0.0, 1.0);
    this->Deformation->SetInputConnection(this->Inside->GetOutputPort());
    this->Deformation->SetScratchDirectory(this->Folder.path().c_str());
  }

  vtkPointSet* output()
  {
    return vtkPointSet::SafeDownCast(this->Deformation->GetOutputDataObject(0));
  }

  static Eigen::Matrix3Xd pointsOf(vtkPointSet& mesh)
  {
    Eigen::Matrix3Xd points(3, mesh.GetNumberOfPoints());
    for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i)
    {
      mesh.GetPoint(i, points.col(i).data());
    }
    return points;
  }

  /** The largest distance of the points of the deformed preview from those of the deformed mesh, in
   * units of the largest displacement of the latter. */
  double errorOfPreview()
  {
    this->Reader->SetMaximumPointsInMemory(1000000);
    EXPECT_TRUE(updatePiece(this->Reader, 0, 1));
    const Eigen::Matrix3Xd before =
      pointsOf(*vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0)));
    EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
    const Eigen::Matrix3Xd full = pointsOf(*this->output());
    this->Reader->SetMaximumPointsInMemory(100);
    this->Reader->SetPreviewPoints(10000);
    EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
    vtkDataArray* ids = this->output()->GetPointData()->GetGlobalIds();
    const Eigen::Matrix3Xd preview = pointsOf(*this->output());
    double error = 0.0;
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
    {
      const auto id = static_cast<vtkIdType>(ids->GetTuple1(i));
      error = std::max(error, (preview.col(i) - full.col(id)).norm());
    }
    return error / (full - before).colwise().norm().maxCoeff();
  }

  TemporaryFolder Folder;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkPlane> Floor;
  vtkNew<vtkSphere> Ball;
  vtkNew<vtkMeshHandle> Below, Inside;
  vtkNew<vtkStreamingMeshDeformation> Deformation;
};

TEST_F(VtkSolidDeformation, APreviewOfTetrahedraFollowsAHandleInside)
{
  this->Reader->SetPreviewCells(vtkStreamingMeshReader::TETRAHEDRA);
  const double error = this->errorOfPreview();
  EXPECT_LT(error, 0.2);
  EXPECT_EQ(this->output()->GetCell(0)->GetCellType(), VTK_TETRA);
  EXPECT_LT(this->output()->GetNumberOfPoints(), 24 * 24 * 24 / 20 + 1);
  EXPECT_GT(this->Inside->GetNumberOfHeldPoints(), 5);
  EXPECT_EQ(std::string(this->Deformation->GetNotes()).find("surface"), std::string::npos);
  // Only the motion changes: the hierarchy stays.
  const int builds = this->Deformation->GetNumberOfBuilds();
  this->Inside->SetTranslation(-3.0, 2.0, 0.0);
  EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
  EXPECT_EQ(this->Deformation->GetNumberOfBuilds(), builds);
}

TEST_F(VtkSolidDeformation, APreviewOfTheSurfaceCannotAndSaysSo)
{
  Errors warnings(this->Inside);
  const double error = this->errorOfPreview();
  EXPECT_GT(error, 0.5) << error;
  EXPECT_EQ(this->output()->GetCell(0)->GetCellType(), VTK_TRIANGLE);
  EXPECT_NE(std::string(this->Deformation->GetNotes()).find("Preview Cells of the reader"),
    std::string::npos);
}

/** Handles that hold nothing of what is shown. */
TEST_F(VtkSolidDeformation, APreviewWithoutAHeldPointStaysAsItIs)
{
  this->Deformation->SetInputConnection(this->Inside->GetOutputPort());
  this->Inside->SetInputConnection(this->Reader->GetOutputPort());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(1000);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  const Eigen::Matrix3Xd before =
    pointsOf(*vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0)));
  constexpr vtkIdType Middle = (12 * 24 + 12) * 24 + 12; // by the numbers of the box
  this->Inside->SetIdType(vtkMeshHandle::ORIGINAL_IDS);
  this->Inside->AddId(Middle);
  this->Inside->AddPoint(11.5, 11.5, 11.5);
  for (const int region : { vtkMeshHandle::FUNCTION, vtkMeshHandle::IDS, vtkMeshHandle::POINTS })
  {
    this->Inside->SetRegion(region);
    Errors ofHandle(this->Inside), ofDeformation(this->Deformation);
    EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
    EXPECT_EQ(pointsOf(*this->output()), before) << region;
    EXPECT_EQ(this->Inside->GetNumberOfHeldPoints(), 0) << region;
    EXPECT_TRUE(ofHandle.contain("PreviewCells of the reader offers tetrahedra"))
      << ofHandle.text();
    EXPECT_TRUE(ofDeformation.contain("handles hold no point of the preview, which stays as it is"))
      << ofDeformation.text();
    this->Deformation->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
    EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
    EXPECT_NE(pointsOf(*this->output()), before) << region;
    this->Deformation->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  }
  this->Inside->SetRegion(vtkMeshHandle::POINTS);
  this->Inside->AddPoint(0.0, 12.0, 12.0);
  EXPECT_TRUE(updatePiece(this->Deformation, 0, 1));
  EXPECT_EQ(this->Inside->GetNumberOfHeldPoints(), 1);
  EXPECT_NE(pointsOf(*this->output()), before);
}

TEST_F(VtkSolidDeformation, PreviewsOfSurfacesAreTriangles)
{
  writeVsm(this->Folder / "torus.vsm", torus(60, 30));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewCells(vtkStreamingMeshReader::TETRAHEDRA);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  auto* preview = vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  EXPECT_EQ(preview->GetCell(0)->GetCellType(), VTK_TRIANGLE);
}

} // namespace
} // namespace smg::testing
