// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Filters/MeshConditionFixture.h"

#include "vtkSphere.h"

#include <algorithm>
#include <iomanip>
#include <iterator>
#include <sstream>

namespace smg::testing
{

using VtkConditionPreview = VtkMeshCondition;

TEST_F(VtkConditionPreview, HoldsOnAPreviewWhatItHoldsOnTheMesh)
{
  const StreamMesh mesh = writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(2.5, 0, 0);
  sphere->SetRadius(1.2);
  vtkMeshCondition& condition = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  condition.SetRegionFunction(sphere);
  ASSERT_EQ(updatePiece(&condition, 0, 1), 1);
  auto* whole = vtkPointSet::SafeDownCast(condition.GetOutputDataObject(0));
  std::vector<bool> isHeld;
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    isHeld.push_back(whole->GetPointData()->GetArray("Condition1")->GetTuple1(i) != 0.0);
    const double* p = whole->GetPoint(i);
    EXPECT_EQ(isHeld.back(), (p[0] - 2.5) * (p[0] - 2.5) + p[1] * p[1] + p[2] * p[2] <= 1.44);
  }
  this->Reader->SetMaximumPointsInMemory(100);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(500);
  ASSERT_EQ(updatePiece(&condition, 0, 1), 1);
  auto* preview = vtkPointSet::SafeDownCast(condition.GetOutputDataObject(0));
  ASSERT_LT(preview->GetNumberOfPoints(), mesh.vertices());
  ASSERT_GT(condition.GetNumberOfHeldPoints(), 0);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_EQ(preview->GetPointData()->GetArray("Condition1")->GetTuple1(i) != 0.0, isHeld[id]);
  }
}

TEST_F(VtkConditionPreview, AProblemThatAPreviewCannotHoldIsSolvedOnTheMesh)
{
  const StreamMesh mesh = writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  const auto solvedOn = [&](const std::string& problem)
  {
    this->Poisson->SetProblem(problem.c_str());
    EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 1);
    return static_cast<std::int64_t>(numberAt(this->Poisson->GetReport(), "/vertices"));
  };
  Errors errors(this->Poisson);
  EXPECT_LE(solvedOn(R"({"source": [1], "screening": 1})"), 300);
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(solvedOn(R"({"source": [1], "screening": 1,
    "conductivity": [{"tag": ["OriginalCellId", 1000003], "value": 2}]})"),
    mesh.vertices());
  EXPECT_TRUE(errors.contain("but the preview does not show them: problem: conductivity[0].tag"))
    << errors.text();
  EXPECT_NE(std::string(this->Poisson->GetNotes()).find("since the preview does not do: problem: "),
    std::string::npos)
    << this->Poisson->GetNotes();

  ASSERT_EQ(updatePiece(this->Reader, 0, 1), 1);
  auto* preview = vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  std::vector<bool> isShown(static_cast<std::size_t>(mesh.vertices()), false);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    isShown[static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i))] = true;
  }
  const auto hidden = std::ranges::find(isShown, false) - isShown.begin();
  std::ostringstream at;
  at << std::setprecision(17);
  std::copy_n(mesh.positions.begin() + 3 * hidden, 3, std::ostream_iterator<double>(at, ", "));
  EXPECT_EQ(solvedOn(R"({"screening": 1, "dirichlet": [{"sphere": [)" + at.str() +
                     R"(1e-6], "value": [1]}]})"),
    mesh.vertices());
}

TEST_F(VtkConditionPreview, ThePreviewOfASolidHasTheTrueSolutionAndNoGradient)
{
  this->Poisson->SetProblem(R"({"source": [1], "screening": 1})");
  const Results whole = this->filter(1);
  this->Reader->SetMaximumPointsInMemory(10);
  this->Reader->SetPreviewPoints(40);
  Errors errors(this->Poisson);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_TRUE(errors.contain("values of the tetrahedra of the solid")) << errors.text();
  auto* preview = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  ASSERT_LE(preview->GetNumberOfPoints(), 40);
  EXPECT_FALSE(preview->GetCellData()->HasArray("Gradient"));
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_EQ(preview->GetPointData()->GetArray("Solution")->GetTuple1(i), whole.solution[id]);
  }
}

TEST_F(VtkConditionPreview, TheReportOfAPreviewNamesVerticesOfTheFile)
{
  writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  this->Poisson->SetProblem(
    R"({"screening": 1, "source": [{"sphere": [3, 0, 0, 1.5], "value": 1}]})");
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  const double maximum = numberAt(this->Poisson->GetReport(), "/maximum/0/value");
  const double vertex = numberAt(this->Poisson->GetReport(), "/maximum/0/vertex");
  auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  auto* ids = output->GetPointData()->GetArray("OriginalId");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const bool isLargest = output->GetPointData()->GetArray("Solution")->GetTuple1(i) == maximum;
    EXPECT_EQ(isLargest, ids->GetTuple1(i) == vertex) << i;
  }
}

} // namespace smg::testing
