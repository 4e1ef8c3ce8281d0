// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/Filters/PoissonFixture.h"

#include "vtkBox.h"
#include "vtkDataArraySelection.h"
#include "vtkPassThrough.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <set>
#include <string>

// Solves on previews, full meshes, files and pieces: their values, and what the outcome says of
// them.

namespace smg::testing
{
namespace
{

class VtkSolvePlace : public VtkStreamingPoisson
{
protected:
  std::string text()
  {
    auto* table =
      vtkTable::SafeDownCast(this->Poisson->GetOutputDataObject(vtkStreamingSolver::TEXT));
    EXPECT_EQ(table->GetNumberOfRows(), 1);
    return vtkStringArray::SafeDownCast(table->GetColumn(0))->GetValue(0);
  }

  void showPreview(int points)
  {
    this->Reader->SetMaximumPointsInMemory(100);
    this->Reader->SetPreviewPoints(points);
  }

  /** Whether a text is the beginning of the outcome. */
  bool outcomeBegins(const std::string& words)
  {
    return std::string(this->Poisson->GetOutcome()).starts_with(words);
  }
};

} // namespace

TEST_F(VtkSolvePlace, AShortSolveIsThatOfTheFullMeshAndSaysSo)
{
  const PieceUnion whole = this->collectPieces(1);
  EXPECT_EQ(this->text(), ""); // all of the mesh is shown
  EXPECT_TRUE(this->outcomeBegins("Converged")) << this->Poisson->GetOutcome();
  this->showPreview(600);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  EXPECT_TRUE(this->outcomeBegins(this->text() + " Converged")) << this->Poisson->GetOutcome();
  EXPECT_EQ(this->text(), "On the full mesh of 1,800 points.");
  vtkPointSet* preview = this->output();
  ASSERT_LE(preview->GetNumberOfPoints(), 600);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id =
      static_cast<std::int64_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_EQ(
      preview->GetPointData()->GetArray("Solution")->GetComponent(i, 0), whole.values.at(id)[0]);
  }
}

TEST_F(VtkSolvePlace, APreviewSaysHowFarItMayBeOff)
{
  const PieceUnion whole = this->collectPieces(1);
  this->showPreview(1200);
  this->Poisson->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  const std::string text = this->text();
  std::string words = text;
  std::ranges::replace(words, '\n', ' ');
  EXPECT_TRUE(this->outcomeBegins(words)) << this->Poisson->GetOutcome();
  double mean = 0.0, most = 0.0;
  ASSERT_EQ(
    std::sscanf(text.c_str(),
      "On the preview only: 1,200 of 1,800 points,\nthe result on a quarter of which differs by "
      "%lg in the mean, %lg",
      &mean, &most),
    2)
    << text;
  EXPECT_LT(mean, most);
  vtkPointSet* preview = this->output();
  double sum = 0.0;
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id =
      static_cast<std::int64_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    double squares = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double off = preview->GetPointData()->GetArray("Solution")->GetComponent(i, k) -
                         whole.values.at(id)[static_cast<std::size_t>(k)];
      squares += off * off;
    }
    sum += std::sqrt(squares);
  }
  const double truth = sum / static_cast<double>(preview->GetNumberOfPoints());
  EXPECT_LT(truth, 2.0 * mean);
  EXPECT_GT(truth, 0.05 * mean);
  // What is saved is that of the mesh.
  ASSERT_TRUE(streamPiece(this->Poisson, 0, 1));
  EXPECT_TRUE(this->outcomeBegins(words)) << this->Poisson->GetOutcome(); // that is still shown
  EXPECT_NE(std::string(this->Poisson->GetOutcome()).find("On the full mesh of 1,800 points."),
    std::string::npos);
  EXPECT_EQ(this->text(), text);
}

TEST_F(VtkSolvePlace, ThePassesAreATable)
{
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 1));
  auto* table =
    vtkTable::SafeDownCast(this->Poisson->GetOutputDataObject(vtkStreamingSolver::PASSES));
  ASSERT_EQ(table->GetNumberOfRows(), this->Poisson->GetPasses());
  auto* residuals = vtkDataArray::SafeDownCast(table->GetColumnByName("Residual"));
  EXPECT_GE(residuals->GetTuple1(0), 1.0); // of zero, beside that of the best constant
  EXPECT_EQ(residuals->GetTuple1(table->GetNumberOfRows() - 1), this->Poisson->GetResidual());
  this->Poisson->SetTolerance(-1.0);
  const Errors errors(this->Poisson);
  updatePiece(this->Poisson, 0, 1);
  EXPECT_EQ(table->GetNumberOfRows(), 0);
  EXPECT_EQ(this->text(), "");
}

TEST_F(VtkSolvePlace, ATableThatIsAskedForAloneDoesNotChangeTheMesh)
{
  const PieceUnion whole = this->collectPieces(1);
  ASSERT_TRUE(updatePiece(this->Poisson, 3, 4));
  for (const int port : { vtkStreamingSolver::PASSES, vtkStreamingSolver::TEXT })
  {
    this->Poisson->Update(port);
    auto* table = vtkTable::SafeDownCast(this->Poisson->GetOutputDataObject(port));
    EXPECT_GT(table->GetNumberOfRows(), 0);
    EXPECT_EQ(this->collectPieces(1).values, whole.values);
    ASSERT_TRUE(updatePiece(this->Poisson, 3, 4));
  }
}

/** The file has columns that the reader does not deliver. */
TEST_F(VtkSolvePlace, ColumnsThatAreSwitchedOffDoNotCount)
{
  vtkNew<vtkPassThrough> pieces;
  pieces->SetInputConnection(this->Reader->GetOutputPort());
  this->Reader->UpdateInformation();
  this->Reader->GetPointDataArraySelection()->DisableArray("OriginalId");
  std::vector<double> values[2];
  for (const bool isDirect : { true, false })
  {
    vtkNew<vtkStreamingDistance> distance;
    distance->SetInputConnection(
      isDirect ? this->Reader->GetOutputPort() : pieces->GetOutputPort());
    distance->SetFrom(R"({"vertices": [5]})");
    ASSERT_TRUE(updatePiece(distance, 0, 1));
    auto* output = vtkPointSet::SafeDownCast(distance->GetOutputDataObject(0));
    vtkDataArray* found = output->GetPointData()->GetArray("Distance");
    for (vtkIdType i = 0; i < found->GetNumberOfTuples(); ++i)
    {
      values[isDirect].push_back(found->GetTuple1(i));
    }
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(values[0][5], 0.0);
}

/** A region between the points of the preview is one of the mesh. */
TEST_F(VtkSolvePlace, ARegionWithoutAPointOfThePreviewCounts)
{
  this->showPreview(300);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  std::set<vtkIdType> shown;
  vtkDataArray* ids =
    vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0))->GetPointData()->GetGlobalIds();
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    shown.insert(static_cast<vtkIdType>(ids->GetTuple1(i)));
  }
  vtkIdType hidden = 0;
  while (shown.contains(hidden))
  {
    ++hidden;
  }
  vtkNew<vtkMeshRegion> region;
  region->SetInputConnection(this->Reader->GetOutputPort());
  vtkNew<vtkBox> box; // around that vertex alone
  const double* p = this->Mesh.positions.data() + 3 * hidden;
  box->SetBounds(p[0] - 1e-3, p[0] + 1e-3, p[1] - 1e-3, p[1] + 1e-3, p[2] - 1e-3, p[2] + 1e-3);
  region->SetRegionFunction(box);
  for (const int solve : { vtkStreamingSolver::AUTOMATIC_SOLVE, vtkStreamingSolver::ON_FULL_MESH,
         vtkStreamingSolver::ON_PREVIEW })
  {
    vtkNew<vtkStreamingDistance> distance;
    distance->SetInputConnection(region->GetOutputPort());
    distance->SetSolve(solve);
    const Errors errors(distance);
    EXPECT_EQ(updatePiece(distance, 0, 1), solve != vtkStreamingSolver::ON_PREVIEW);
    EXPECT_EQ(errors.contain("No point of the preview"), solve == vtkStreamingSolver::ON_PREVIEW)
      << errors.text();
    ASSERT_TRUE(streamPiece(distance, 0, 1));
    auto* output = vtkPointSet::SafeDownCast(distance->GetOutputDataObject(0));
    EXPECT_EQ(output->GetPointData()->GetArray("Distance")->GetTuple1(hidden), 0.0);
  }
}

/** A filter between the reader and the job makes it pull pieces. */
TEST_F(VtkSolvePlace, AFileAndItsPiecesGiveTheSameBits)
{
  const auto expectSame = [&](vtkStreamingSolver& filter, const char* name)
  {
    vtkNew<vtkPassThrough> pieces;
    pieces->SetInputConnection(this->Reader->GetOutputPort());
    std::vector<double> values[2];
    for (const bool isFile : { true, false })
    {
      filter.SetInputConnection(isFile ? this->Reader->GetOutputPort() : pieces->GetOutputPort());
      ASSERT_TRUE(updatePiece(&filter, 0, 1));
      auto* output = vtkPointSet::SafeDownCast(filter.GetOutputDataObject(0));
      vtkDataArray* found =
        name ? output->GetPointData()->GetArray(name) : output->GetPoints()->GetData();
      for (vtkIdType i = 0; i < found->GetNumberOfValues(); ++i)
      {
        values[isFile].push_back(found->GetVariantValue(i).ToDouble());
      }
      // The copy of the pieces takes time, the file of the reader none.
      const bool copies =
        std::string(filter.GetReport()).find("\"convert\": 0.0,") == std::string::npos;
      EXPECT_EQ(copies, !isFile) << filter.GetReport();
    }
    EXPECT_EQ(values[0], values[1]) << filter.GetClassName();
  };
  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetProblem(R"({"source": [1], "screening": 1})");
  expectSame(*poisson, "Solution");
  vtkNew<vtkStreamingDistance> distance;
  distance->SetFrom(R"({"vertices": [7]})");
  expectSame(*distance, "Distance");
  expectSame(*vtkNew<vtkStreamingMeshSmoothing>(), nullptr);
}

} // namespace smg::testing
