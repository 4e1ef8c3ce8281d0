// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSimplification.h"
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Simplify.h"
#include "smg/VsmReader.h"

#include "vtkNew.h"
#include "vtkPassThrough.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

// The filter simplifies as the library does, whatever its input is, and delivers a mesh stream.

namespace smg::testing
{
namespace
{

class VtkStreamingMeshSimplification : public ::testing::Test
{
protected:
  VtkStreamingMeshSimplification()
  {
    this->Mesh = toStream(shuffled(torus(120, 60, 0.2)), TestOrder::BreadthFirst);
    addColumns(this->Mesh);
    writeMesh(this->Folder / "mesh.vsm", this->Mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->SetMaximumPointsInMemory(100);
    this->Filter->SetInputConnection(this->Reader->GetOutputPort());
    this->Filter->SetScratchDirectory(this->Folder.path().c_str());
    this->Filter->SetNumberOfVertices(900);
  }

  /** The positions of the points of all pieces that no earlier piece has, and the number of cells.
   */
  std::pair<std::vector<double>, std::int64_t> collectPieces(int pieces)
  {
    std::vector<double> positions;
    std::int64_t cells = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Filter, piece, pieces));
      vtkPolyData& part = *this->Filter->GetOutput();
      cells += part.GetNumberOfCells();
      for (vtkIdType i = 0; i < part.GetNumberOfPoints(); ++i)
      {
        if (part.GetPointData()->GetArray("vtkGhostType")->GetTuple1(i) == 0.0)
        {
          const double* p = part.GetPoint(i);
          positions.insert(positions.end(), p, p + 3);
        }
      }
    }
    return { positions, cells };
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingMeshSimplification> Filter;
};

} // namespace

TEST_F(VtkStreamingMeshSimplification, IsThatOfTheLibraryInAnyPieces)
{
  const auto file = this->Folder / "expected.vsm";
  const SimplifyReport report = simplify(VsmReader(this->Folder / "mesh.vsm"), { .vertices = 900 },
    file, { .memoryLimit = std::int64_t(256) << 20 });
  const StreamMesh expected = collect(*VsmReader(file).source());
  ASSERT_LE(expected.vertices(), 900);
  for (const int pieces : { 1, 3, 8 })
  {
    EXPECT_EQ(this->collectPieces(pieces), std::pair(expected.positions, expected.cells()));
  }
  EXPECT_EQ(this->Filter->GetReachedError(), report.error);
  EXPECT_EQ(
    std::string(this->Filter->GetOutcome()).find("900 points and 1,800 triangles of 7,200"), 0U)
    << this->Filter->GetOutcome();
  // Points keep their own values.
  vtkPolyData* output = this->Filter->GetOutput();
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  vtkDataArray* ids = output->GetPointData()->GetArray("OriginalId");
  vtkDataArray* colours = output->GetPointData()->GetArray("Colours");
  ASSERT_TRUE(ids && colours);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const auto original = static_cast<std::int64_t>(ids->GetTuple1(i));
    const auto at = std::ranges::find(this->Mesh.originalIds, original);
    const auto vertex = at - this->Mesh.originalIds.begin();
    ASSERT_EQ(colours->GetComponent(i, 1), double(vertex));
  }
}

TEST_F(VtkStreamingMeshSimplification, OfAMeshShownAsAPreviewIsNoPreview)
{
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  ASSERT_TRUE(isPreview(*vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0))));
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  EXPECT_FALSE(isPreview(*this->Filter->GetOutput()));
  EXPECT_EQ(pointsBehind(*this->Filter->GetOutput()), 0);
  const std::int64_t points = this->Filter->GetOutput()->GetNumberOfPoints();
  for (const char* name : { "small.vsm", "small.ply" })
  {
    vtkNew<vtkStreamingMeshWriter> writer;
    writer->SetInputConnection(this->Filter->GetOutputPort());
    writer->SetFileName((this->Folder / name).c_str());
    EXPECT_TRUE(writer->Write()) << name;
  }
  EXPECT_EQ(VsmReader(this->Folder / "small.vsm").info().vertices, points);
}

TEST_F(VtkStreamingMeshSimplification, TakesPiecesAndOrdinaryMeshes)
{
  vtkNew<vtkPassThrough> pieces;
  pieces->SetInputConnection(this->Reader->GetOutputPort());
  this->Filter->SetInputConnection(pieces->GetOutputPort());
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 900);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(100);
  sphere->SetPhiResolution(80);
  this->Filter->SetInputConnection(sphere->GetOutputPort());
  this->Filter->SetNumberOfVertices(0);
  this->Filter->SetMaximumError(0.005); // of a radius of 0.5
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  vtkPolyData* output = this->Filter->GetOutput();
  EXPECT_LT(output->GetNumberOfPoints(), 1500);
  EXPECT_GT(output->GetNumberOfPoints(), 50);
  EXPECT_LE(this->Filter->GetReachedError(), 0.005);
  EXPECT_TRUE(output->GetPointData()->GetNormals());
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* p = output->GetPoint(i);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 0.5, 1e-6);
  }
  // The result is a mesh like any other.
  vtkNew<vtkStreamingPoisson> poisson;
  poisson->SetInputConnection(this->Filter->GetOutputPort());
  poisson->SetProblem(R"({"source": [1], "screening": 1})");
  ASSERT_TRUE(updatePiece(poisson, 0, 1));
  EXPECT_EQ(poisson->GetConverged(), 1);
}

/** As the library holds them; the points of a region before the filter and those that Hold names.
 */
TEST_F(VtkStreamingMeshSimplification, HoldsRegionsAndWhatHoldNames)
{
  const auto file = this->Folder / "expected.vsm";
  const std::vector<Where> hold{ smg::sphere({ 3.0, 0.0, 0.0 }, 0.5), Region::Vertices{ { 7 } } };
  simplify(VsmReader(this->Folder / "mesh.vsm"), { .vertices = 900 }, file,
    { .hold = hold, .memoryLimit = std::int64_t(256) << 20 });
  const std::vector<double> expected = collect(*VsmReader(file).source()).positions;
  const std::vector<double> free = this->collectPieces(1).first;
  EXPECT_NE(expected, free);
  this->Filter->SetHold(R"([{"sphere": [3, 0, 0, 0.5]}, {"vertices": [7]}])");
  EXPECT_EQ(this->collectPieces(1).first, expected);
  // A region instead of a part in JSON, by pieces and on an ordinary mesh.
  vtkNew<vtkSphere> part;
  part->SetCenter(3.0, 0.0, 0.0);
  part->SetRadius(0.5);
  vtkNew<vtkMeshRegion> region;
  region->SetInputConnection(this->Reader->GetOutputPort());
  region->SetRegion(vtkMeshRegion::FUNCTION);
  region->SetRegionFunction(part);
  this->Filter->SetInputConnection(region->GetOutputPort());
  this->Filter->SetHold(R"({"vertices": [7]})");
  const auto numberIn = [&](const std::vector<double>& positions)
  {
    int points = 0;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      points += part->FunctionValue(positions[i], positions[i + 1], positions[i + 2]) <= 0.0;
    }
    return points;
  };
  EXPECT_GT(numberIn(this->Mesh.positions), 2 * numberIn(free));
  EXPECT_EQ(numberIn(this->collectPieces(1).first), numberIn(this->Mesh.positions));
  EXPECT_FALSE(std::string(this->Filter->GetEstimate()).empty());
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(100);
  ball->SetPhiResolution(80);
  part->SetCenter(0.5, 0.0, 0.0);
  part->SetRadius(0.1);
  region->SetInputConnection(ball->GetOutputPort());
  this->Filter->SetHold(nullptr);
  this->Filter->SetNumberOfVertices(400);
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  const auto inPart = [&](vtkPointSet& mesh)
  {
    vtkIdType points = 0;
    for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i)
    {
      points += part->FunctionValue(mesh.GetPoint(i)) <= 0.0 ? 1 : 0;
    }
    return points;
  };
  ball->Update();
  EXPECT_GT(inPart(*ball->GetOutput()), 50);
  EXPECT_EQ(inPart(*this->Filter->GetOutput()), inPart(*ball->GetOutput()));
}

TEST_F(VtkStreamingMeshSimplification, MistakesAreOneErrorEach)
{
  const auto expect = [this](const std::string& words)
  {
    const Errors errors(this->Filter);
    EXPECT_FALSE(updatePiece(this->Filter, 0, 1));
    EXPECT_TRUE(errors.contain(words)) << errors.text();
    EXPECT_EQ(std::string(this->Filter->GetOutcome()).find("Failed: "), 0U);
    EXPECT_EQ(this->Folder.entries(), 1);
  };
  this->Filter->SetNumberOfVertices(0);
  expect("set NumberOfVertices, MaximumError or both above 0");
  this->Filter->SetNumberOfVertices(900);
  this->Filter->SetHold(R"({"sphere": [1]})");
  expect("Hold: sphere: must be");
  this->Filter->SetHold(R"({"sphere": [9, 9, 9, 1]})");
  expect("hold[0]: no vertex");
  this->Filter->SetHold(nullptr);
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
}

} // namespace smg::testing
