// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/AbortTesting.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Smooth.h"
#include "smg/VsmReader.h"

#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkPolyData.h"

#include <cmath>
#include <functional>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshSmoothing : public ::testing::Test
{
protected:
  VtkStreamingMeshSmoothing()
  {
    this->open(torus(60, 30, 0.2));
    this->Smoothing->SetInputConnection(this->Reader->GetOutputPort());
    this->Smoothing->SetNumberOfPieces(5);
    this->Smoothing->SetScratchDirectory(this->Folder.path().c_str());
  }

  void open(const IndexedTestMesh& mesh)
  {
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    this->Mesh = writeVsm(this->Folder / name, mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
  }

  vtkPointSet* output()
  {
    return vtkPointSet::SafeDownCast(this->Smoothing->GetOutputDataObject(0));
  }

  PieceUnion collectPieces(int pieces, const char* watched = nullptr)
  {
    PieceUnion all;
    if (watched)
    {
      all.watched = watched;
    }
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Smoothing, piece, pieces));
      all.add(this->output(), piece);
    }
    return all;
  }

  /** The values that smooth() computes. */
  std::vector<double> smoothed(const smg::Smoothing& options) const
  {
    const MemoryMesh mesh(this->Mesh);
    const std::unique_ptr<Solution> solution = smooth(mesh, options, options);
    std::vector<double> values(
      static_cast<std::size_t>(solution->vertices() * solution->columns()));
    solution->read(0, solution->vertices(), values);
    return values;
  }
  StreamMesh movedBy(const smg::Smoothing& options) const
  {
    StreamMesh mesh = this->Mesh;
    mesh.positions = this->smoothed(options);
    return mesh;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingMeshSmoothing> Smoothing;
};

TEST_F(VtkStreamingMeshSmoothing, EveryWayGivesThePointsOfTheLibrary)
{
  const StreamMesh expected = this->movedBy({});
  EXPECT_NE(expected.positions, this->Mesh.positions);
  // ParaView's name of no array.
  this->Smoothing->SetColumn("None");
  this->collectPieces(1).expectEqual(expected);
  for (const int pieces : { 1, 3, 16 })
  {
    this->collectPieces(pieces).expectEqual(expected);
  }
  EXPECT_EQ(this->Smoothing->GetConverged(), 1);
  EXPECT_NE(std::string(this->Smoothing->GetReport()).find("\"volume\""), std::string::npos);
}

TEST_F(VtkStreamingMeshSmoothing, EveryPropertyIsAnOptionOfTheLibrary)
{
  smg::Smoothing options;
  options.size = { 0.05, SmoothingSize::Diagonal };
  options.steps = 3;
  options.keepVolume = false;
  options.keepEdges = 20.0;
  options.boundary = SmoothedBoundary::Fixed;
  options.hold = { Region::Sphere{ { 3, 0, 0 }, 1 }, Region::Vertices{ { 7 } } };
  this->open(grid(30, 20, 0.1));
  this->Smoothing->SetSize(0.05);
  this->Smoothing->SetSizeUnit(vtkStreamingMeshSmoothing::DIAGONAL);
  this->Smoothing->SetSteps(3);
  this->Smoothing->KeepVolumeOff();
  this->Smoothing->KeepEdgesOn();
  this->Smoothing->SetEdgeAngle(20.0);
  this->Smoothing->SetBoundary(vtkStreamingMeshSmoothing::FIXED);
  this->Smoothing->SetHold(R"([{"sphere": [3, 0, 0, 1]}, {"vertices": [7]}])");
  for (const int pulled : { 0, 3 })
  {
    this->Smoothing->SetNumberOfPieces(pulled);
    this->collectPieces(1).expectEqual(this->movedBy(options));
  }
  for (const auto boundary : { SmoothedBoundary::Smooth, SmoothedBoundary::Free })
  {
    options.boundary = boundary;
    this->Smoothing->SetBoundary(boundary == SmoothedBoundary::Smooth
                                   ? vtkStreamingMeshSmoothing::SMOOTH
                                   : vtkStreamingMeshSmoothing::FREE);
    this->collectPieces(2).expectEqual(this->movedBy(options));
  }
}

TEST_F(VtkStreamingMeshSmoothing, AnArrayIsSmoothedInsteadOfThePoints)
{
  this->open(tetBox(8, 7, 6, 0.1));
  smg::Smoothing options;
  options.column = "Colours";
  const std::vector<double> expected = this->smoothed(options);
  this->Smoothing->SetColumn("Colours");
  for (const int pulled : { 0, 3 })
  {
    this->Smoothing->SetNumberOfPieces(pulled);
    this->collectPieces(3).expectEqual(this->Mesh);
    ASSERT_TRUE(updatePiece(this->Smoothing, 0, 1));
    vtkDataArray* array = this->output()->GetPointData()->GetArray("Colours");
    ASSERT_TRUE(vtkFloatArray::SafeDownCast(array));
    ASSERT_EQ(array->GetNumberOfComponents(), 3);
    vtkDataArray* ids = this->output()->GetPointData()->GetGlobalIds();
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      const auto id = static_cast<std::size_t>(ids->GetTuple1(i));
      ASSERT_EQ(
        array->GetComponent(i, 1), static_cast<double>(static_cast<float>(expected[3 * id + 1])));
    }
  }
}

TEST_F(VtkStreamingMeshSmoothing, WhatIsWrittenIsTheWholeMeshAndAPreviewIsSmoothedByItself)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Smoothing->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  ASSERT_TRUE(updatePiece(this->Smoothing, 0, 1));
  EXPECT_TRUE(this->output()->GetFieldData()->HasArray("Preview"));
  EXPECT_LT(this->output()->GetNumberOfPoints(), 600);
  EXPECT_NE(std::string(this->Smoothing->GetNotes()).find("this is the smoothed preview"),
    std::string::npos);
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Smoothing->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  ASSERT_TRUE(writer->Write());
  const VsmReader reader(this->Folder / "out.vsm");
  EXPECT_EQ(collect(*reader.source()).positions, this->movedBy({}).positions);
}

TEST_F(VtkStreamingMeshSmoothing, NormalsAreThoseOfTheSmoothedSurface)
{
  StreamMesh mesh = this->Mesh;
  mesh.vertexColumns = { makeColumn<float>(
    "Normals", std::vector<float>(mesh.positions.size(), 0.5F), 3) };
  writeMesh(this->Folder / "normals.vsm", mesh);
  this->Reader->SetFileName((this->Folder / "normals.vsm").c_str());
  std::vector<std::vector<double>> found;
  for (const int pulled : { 0, 3 })
  {
    this->Smoothing->SetNumberOfPieces(pulled);
    ASSERT_TRUE(updatePiece(this->Smoothing, 0, 1));
    vtkDataArray* normals = this->output()->GetPointData()->GetArray("Normals");
    ASSERT_TRUE(normals);
    found.emplace_back();
    for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
    {
      // Those of a torus around z: from the middle of the tube outwards.
      const double* p = this->output()->GetPoint(i);
      const double r = std::hypot(p[0], p[1]);
      const double tube = std::hypot(r - 2.0, p[2]);
      const double* n = normals->GetTuple3(i);
      const double along =
        (n[0] * p[0] / r + n[1] * p[1] / r) * (r - 2.0) / tube + n[2] * p[2] / tube;
      EXPECT_GT(std::fabs(along), 0.95);
      found.back().insert(found.back().end(), n, n + 3);
    }
  }
  EXPECT_EQ(found[0], found[1]);
  this->Smoothing->SetNormals(vtkStreamingMeshSmoothing::DROP);
  ASSERT_TRUE(updatePiece(this->Smoothing, 0, 1));
  EXPECT_FALSE(this->output()->GetPointData()->GetArray("Normals"));
}

TEST_F(VtkStreamingMeshSmoothing, CanBeAborted)
{
  expectCanBeAborted(this->Smoothing.Get(), this->Folder);
}

TEST_F(VtkStreamingMeshSmoothing, MistakesAreOneErrorEach)
{
  Errors errors(this->Smoothing);
  const auto expect = [&](const std::string& words, const std::function<void()>& spoil)
  {
    for (const int pulled : { 0, 3 })
    {
      errors.clear();
      this->Smoothing->SetNumberOfPieces(pulled);
      spoil();
      EXPECT_FALSE(updatePiece(this->Smoothing, 0, 1));
      EXPECT_TRUE(errors.contain(words)) << errors.text();
      this->Smoothing->SetHold(nullptr);
      this->Smoothing->SetColumn(nullptr);
      this->Smoothing->SetSize(4.0);
      this->Smoothing->SetSteps(1);
    }
  };
  expect("Hold: sphere: must be", [&] { this->Smoothing->SetHold(R"({"sphere": [1]})"); });
  expect("hold[0]: no vertex", [&] { this->Smoothing->SetHold(R"({"sphere": [9, 9, 9, 1]})"); });
  expect("no numeric array Missing of its points or cells (it has ",
    [&] { this->Smoothing->SetColumn("Missing"); });
  expect("from 1 to 1,000", [&] { this->Smoothing->SetSteps(0); });
  expect("from 1 to 1,000", [&] { this->Smoothing->SetSteps(1001); });
  this->Smoothing->SetSizeUnit(vtkStreamingMeshSmoothing::DIAGONAL);
  expect("the size of the details to smooth (property Size), ",
    [&] { this->Smoothing->SetSize(1e200); });
  this->Smoothing->SetSizeUnit(vtkStreamingMeshSmoothing::MEAN_EDGES);
  this->open(tetBox(4, 4, 4));
  expect("choose a point array to smooth", [] {});
}

} // namespace
} // namespace smg::testing
