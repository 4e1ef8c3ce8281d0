// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshDeformation.h"
#include "Testing/Filters/MeshHandleFixture.h"

#include "vtkCylinder.h"
#include "vtkPlane.h"
#include "vtkPolyData.h"

#include <limits>

namespace smg::testing
{
namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();

/** The errors of an algorithm, without those of its executive. */
class ErrorCount
{
public:
  explicit ErrorCount(vtkAlgorithm* algorithm)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<ErrorCount*>(self)->Texts.emplace_back(static_cast<const char*>(text)); });
    algorithm->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }

  std::vector<std::string> Texts;

private:
  vtkNew<vtkCallbackCommand> Command;
};

TEST_F(VtkMeshHandle, SaysWhatIsWrongInOneSentence)
{
  Errors silent(this->Handle);
  ErrorCount errors(this->Handle);
  const auto expectFailure = [&](const std::string& words)
  {
    errors.Texts.clear();
    EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0) << words;
    ASSERT_EQ(errors.Texts.size(), 1U) << words;
    EXPECT_NE(errors.Texts[0].find(withProperties(words, *this->Handle)), std::string::npos)
      << errors.Texts[0];
    EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), 0);
  };
  this->Handle->SetRegionFunction(nullptr);
  expectFailure("no implicit function");
  this->prepare(this->Handle, this->Reader);
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  this->Handle->SetTranslation(0.0, NaN, 0.0);
  expectFailure("Translation is nan: set it to a finite number.");
  this->Handle->SetTranslation(0.0, 0.0, 0.0);
  this->Handle->SetScale(0.0);
  expectFailure("Scale is 0: set it to a number from 1e-20 to 1e+20.");
  this->Handle->SetScale(1.0);
  this->Handle->SetRotationAxis(0.0, 0.0, 0.0);
  expectFailure("RotationAxis is 0 0 0, which has no direction");
  this->Handle->SetMotion(vtkMeshHandle::TRANSFORM);
  expectFailure("no transform");
  this->Handle->SetMotion(vtkMeshHandle::FIXED);
  this->Handle->SetRegion(vtkMeshHandle::SELECTION);
  expectFailure("no selection");
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  expectFailure("no ids");
  this->Handle->AddId(1800);
  expectFailure("no point with the id 1800");
  this->Handle->AddId(-2);
  expectFailure("Ids is -2: set it to at least 0.");
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  expectFailure("no points");
  this->Handle->AddPoint(0.0, NaN, 0.0);
  expectFailure("Points is nan: set it to a finite number.");
  this->Handle->RemoveAllPoints();
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  this->Handle->SetRadius(NaN);
  expectFailure("Radius is nan: set it to at least 0, or to -1 (automatic).");
  this->Handle->SetRadius(0.0);
  this->Handle->AddPointTarget(0.0, 0.0, NaN);
  expectFailure("PointTargets is nan: set it to a finite number.");
  this->Handle->RemoveAllPointTargets();
  this->Handle->AddPointTarget(0.0, 0.0, 0.0);
  this->Handle->AddPointTarget(0.0, 0.0, 0.0);
  expectFailure("2 point targets for 1 points");
  this->Handle->RemoveAllPointTargets();
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
}

TEST_F(VtkMeshHandle, ARegionThatHoldsNothingIsAnErrorOnceThatIsKnown)
{
  Errors errors(this->Handle);
  this->Ball->SetRadius(1e-6);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("holds nothing")) << errors.text();
  errors.clear();
  EXPECT_EQ(streamPiece(this->Handle, 1, 3), 1);
  EXPECT_EQ(streamPiece(this->Handle, 2, 3), 1);
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(streamPiece(this->Handle, 0, 3), 1);
  EXPECT_EQ(streamPiece(this->Handle, 1, 3), 1);
  EXPECT_EQ(streamPiece(this->Handle, 2, 3), 0);
  EXPECT_TRUE(errors.contain("holds nothing")) << errors.text();
  errors.clear();
  this->Reader->SetMaximumPointsInMemory(100);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_TRUE(errors.contain("No point of the preview")) << errors.text();
  errors.clear();
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  this->Handle->AddId(5);
  this->Handle->AddId(1800);
  EXPECT_EQ(streamPiece(this->Handle, 0, 2), 1);
  EXPECT_EQ(streamPiece(this->Handle, 1, 2), 0);
  EXPECT_TRUE(errors.contain("no point with the id 1800")) << errors.text();
}

TEST_F(VtkMeshHandle, AFunctionMustMakeSense)
{
  Errors errors(this->Handle);
  const auto expectFailure = [&](const std::string& words)
  {
    errors.clear();
    EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0) << words;
    EXPECT_TRUE(errors.contain(words)) << errors.text();
    EXPECT_TRUE(errors.contain("update the input first")) << errors.text();
  };
  for (const double radius : { -1.0, 0.0, NaN })
  {
    this->Ball->SetRadius(radius);
    expectFailure("The sphere of the region has the radius");
  }
  vtkNew<vtkCylinder> cylinder;
  cylinder->SetRadius(-1.0);
  this->Handle->SetRegionFunction(cylinder);
  expectFailure(
    "The cylinder of the region has the radius"); // -1, or the value to which newer VTK clamps it
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(NaN, 0.0, 0.0);
  this->Handle->SetRegionFunction(plane);
  expectFailure("no finite value at the point (");
  plane->SetOrigin(0.0, 0.0, 0.0);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
}

TEST_F(VtkMeshHandle, WarnsOfPointsFarFromTheMesh)
{
  Errors errors(this->Handle);
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  this->Handle->AddPoint(0.0, 0.0, 11.0);
  EXPECT_EQ(collectWhole(this->Handle).held(), 2);
  EXPECT_TRUE(errors.contain("point 1 is at a distance of 10.")) << errors.text();
  // Reported once for the same points.
  errors.clear();
  EXPECT_EQ(collectStreamed(this->Handle, 6).held(), 2);
  EXPECT_EQ(errors.text(), "");
  this->Handle->AddPoint(-3.0, 0.0, 0.0);
  EXPECT_EQ(collectStreamed(this->Handle, 6).held(), 3);
  EXPECT_TRUE(errors.contain("1 of 3 points")) << errors.text();
  // Of a preview, of which vertices of the mesh may be far as well.
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(200);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_TRUE(errors.contain("points of the region are far from the preview: point 1"))
    << errors.text();
  EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), 3);
}

TEST_F(VtkMeshHandle, WarnsOfDistancesInAnyUnit)
{
  IndexedTestMesh small = torus(60, 30, 0.2);
  for (double& coordinate : small.positions)
  {
    coordinate *= 1e-8;
  }
  this->open(small);
  Errors errors(this->Handle);
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->AddPoint(0.0, 0.0, 11e-8);
  EXPECT_EQ(collectWhole(this->Handle).held(), 1);
  EXPECT_TRUE(errors.contain("at a distance of 1.0")) << errors.text();
  EXPECT_TRUE(errors.contain("e-07 from it")) << errors.text();
}

TEST_F(VtkMeshHandle, WarnsOnceOfAPreviewWithoutItsPoints)
{
  Errors errors(this->Handle);
  this->Reader->SetMaximumPointsInMemory(100);
  this->Ball->SetRadius(1e-6);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_TRUE(errors.contain("No point of the preview")) << errors.text();
  errors.clear();
  this->Ball->SetRadius(1e-7);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_EQ(errors.text(), "");
  this->Ball->SetRadius(1.2);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_EQ(errors.text(), "");
  this->Ball->SetRadius(1e-7);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_TRUE(errors.contain("No point of the preview")) << errors.text();
}

TEST_F(VtkMeshHandle, AnEmptyInputIsCalledSo)
{
  Errors errors(this->Handle);
  vtkNew<vtkPolyData> empty;
  this->Handle->SetInputDataObject(empty);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("The input has no points")) << errors.text();
}

TEST_F(VtkMeshHandle, WhatFailedIsNotTakenForAnEmptyMesh)
{
  vtkNew<vtkStreamingMeshDeformation> deformation;
  deformation->SetInputConnection(this->Handle->GetOutputPort());
  Errors errors(this->Handle);
  Errors later(deformation);
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  for (int i = 0; i < 3; ++i)
  {
    this->Handle->SetScale(-1.0 - i);
    errors.clear();
    EXPECT_FALSE(updatePiece(deformation, 0, 1));
    EXPECT_TRUE(errors.contain("Scale is -")) << errors.text();
    EXPECT_FALSE(later.contain("no cells")) << later.text();
    // Nothing has changed: it is neither executed again nor treated as a mesh.
    errors.clear();
    EXPECT_FALSE(updatePiece(deformation, 0, 1));
    EXPECT_EQ(errors.text(), "");
    this->Handle->SetScale(1.0);
    EXPECT_TRUE(updatePiece(deformation, 0, 1));
  }
}

} // namespace
} // namespace smg::testing
