// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/PoissonFixture.h"

#include "vtkFieldData.h"

#include <cmath>

namespace smg::testing
{
namespace
{

class VtkStreamingPoissonErrors : public VtkStreamingPoisson
{
};

TEST_F(VtkStreamingPoissonErrors, ErrorsNameTheArray)
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

TEST_F(VtkStreamingPoissonErrors, FailureOfAPieceIsAnError)
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

TEST_F(VtkStreamingPoissonErrors, FailureEndsStreaming)
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
  // The input fails, its output is rejected, and the solve fails.
  this->Poisson->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
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

  // The same if the filter itself is the source of a stream.
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

TEST_F(VtkStreamingPoissonErrors, WhatIsWrongFromTheStartIsToldBeforePulling)
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
  for (const double tolerance : { -1.0, 1.0, std::nan("") })
  {
    this->Poisson->SetTolerance(tolerance);
    expectError("set it to a number between 0 and 1, both excluded, or to 0 (automatic)");
  }
  this->Poisson->SetTolerance(1e-6);
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  this->Poisson->SetInputArrayToProcess(1, 0, 0, points, "");
  expectError("belong together");
  this->Poisson->SetInputArrayToProcess(0, 0, 0, points, "");
  expectError("Nothing says what to solve");
}

TEST_F(VtkStreamingPoissonErrors, ComponentsMustAgree)
{
  Errors errors(this->Poisson);
  this->Poisson->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mask");
  EXPECT_FALSE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("source: the components of the column 'Mask' are 1, but must have 3"))
    << errors.text();
}

TEST_F(VtkStreamingPoissonErrors, NotConvergingIsAWarning)
{
  Errors errors(this->Poisson);
  this->Poisson->SetMaximumCycles(1);
  this->Poisson->SetTolerance(1e-14);
  EXPECT_TRUE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(errors.contain("did not converge")) << errors.text();
  EXPECT_EQ(this->Poisson->GetConverged(), 0);
}

} // namespace
} // namespace smg::testing
