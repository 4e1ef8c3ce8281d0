// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkMeshHandle.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/AbortTesting.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/Filters/LooseMesh.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Distance.h"
#include "smg/VsmReader.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCurvatures.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmoothPolyDataFilter.h"
#include "vtkTable.h"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace smg::testing
{
namespace
{

class VtkStreamingDistance : public ::testing::Test
{
protected:
  VtkStreamingDistance()
  {
    this->open(torus(60, 30, 0.2));
    this->Distance->SetInputConnection(this->Reader->GetOutputPort());
    this->Distance->SetNumberOfPieces(5);
    this->Distance->SetScratchDirectory(this->Folder.path().c_str());
    this->Distance->SetFrom(R"({"vertices": [7]})");
  }

  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = toStream(mesh);
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    writeMesh(this->Folder / name, this->Mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
  }

  vtkPointSet* output()
  {
    return vtkPointSet::SafeDownCast(this->Distance->GetOutputDataObject(0));
  }

  /** Expects the values of the library, in so many pieces. */
  void expectDistances(const DistanceDescription& description, int pieces)
  {
    const auto expected = distance(MemoryMesh(this->Mesh), description);
    const Eigen::MatrixXd values = valuesOf(*expected);
    const std::vector<ColumnSpec> columns = distanceColumns(description);
    for (int piece = 0; piece < pieces; ++piece)
    {
      ASSERT_TRUE(updatePiece(this->Distance, piece, pieces));
      vtkPointData* points = this->output()->GetPointData();
      EXPECT_EQ(points->HasArray(DistanceSourceName), description.source);
      int first = 0;
      for (const ColumnSpec& column : columns)
      {
        vtkDataArray* array = points->GetArray(column.name.c_str());
        ASSERT_TRUE(array);
        ASSERT_EQ(array->GetNumberOfComponents(), column.components);
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
        {
          const auto id = static_cast<Eigen::Index>(points->GetGlobalIds()->GetTuple1(i));
          for (int k = 0; k < column.components; ++k)
          {
            ASSERT_EQ(array->GetComponent(i, k), values(id, first + k));
          }
        }
        first += column.components;
      }
    }
  }

  static DistanceDescription from(Where where)
  {
    DistanceDescription description;
    description.from.push_back(std::move(where));
    return description;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingDistance> Distance;
};

TEST_F(VtkStreamingDistance, EveryWayGivesTheValuesOfTheLibrary)
{
  DistanceDescription description = from(Region(Region::Vertices{ { 7 } }));
  this->expectDistances(description, 1);
  description.source = description.group = description.direction = true;
  this->Distance->SourceOn();
  this->Distance->GroupOn();
  this->Distance->DirectionOn();
  for (const int pulled : { 0, 3 })
  {
    this->Distance->SetNumberOfPieces(pulled);
    for (const int pieces : { 1, 3, 16 })
    {
      this->expectDistances(description, pieces);
    }
  }
  EXPECT_EQ(this->Distance->GetConverged(), 1);
  EXPECT_NE(std::string(this->Distance->GetReport()).find("\"sources\": 1"), std::string::npos);
  EXPECT_NE(
    std::string(this->Distance->GetOutcome()).find("Converged in 1 pass, "), std::string::npos)
    << this->Distance->GetOutcome();
}

TEST_F(VtkStreamingDistance, WallsOfASolid)
{
  this->open(tetBox(8, 7, 6));
  DistanceDescription description;
  description.wall = true;
  this->Distance->SetFrom(nullptr);
  this->Distance->WallOn();
  for (const int pulled : { 0, 3 })
  {
    this->Distance->SetNumberOfPieces(pulled);
    this->expectDistances(description, 2);
  }
  description.from.emplace_back(Region(Region::HalfSpace{ { 0, 0, -1 }, 0 }));
  this->Distance->SetFrom(R"({"halfspace": [0, 0, -1, 0]})");
  this->expectDistances(description, 2);
}

TEST_F(VtkStreamingDistance, WhatIsWrittenIsTheWholeMeshAndAPreviewIsMeasuredByItself)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Distance->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  this->Distance->SetFrom(R"({"sphere": [2, 0, 1, 0.5]})");
  ASSERT_TRUE(updatePiece(this->Distance, 0, 1));
  EXPECT_TRUE(this->output()->GetFieldData()->HasArray("Preview"));
  EXPECT_TRUE(this->output()->GetPointData()->HasArray(DistanceName));
  EXPECT_NE(std::string(this->Distance->GetNotes()).find("these are distances on the preview"),
    std::string::npos);
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Distance->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  ASSERT_TRUE(writer->Write());
  Column written;
  VsmReader(this->Folder / "out.vsm")
    .readVertexColumn(DistanceName, 0, this->Mesh.vertices(), written);
  const auto expected =
    distance(MemoryMesh(this->Mesh), from(Region(Region::Sphere{ { 2, 0, 1 }, 0.5 })));
  const Eigen::MatrixXd values = valuesOf(*expected);
  for (std::size_t v = 0; v < written.tuples(); ++v)
  {
    ASSERT_EQ(written.value(v), values(static_cast<Eigen::Index>(v), 0));
  }
}

TEST_F(VtkStreamingDistance, WithoutFromTheSourcesAreTheHandles)
{
  const vtkNew<vtkMeshHandle> handle;
  handle->SetInputConnection(this->Reader->GetOutputPort());
  handle->SetRegion(vtkMeshHandle::IDS);
  handle->AddId(7);
  handle->AddId(500);
  this->Distance->SetInputConnection(handle->GetOutputPort());
  this->Distance->SetFrom(nullptr);
  for (const int pulled : { 0, 3 })
  {
    this->Distance->SetNumberOfPieces(pulled);
    this->expectDistances(from(Region(Region::Vertices{ { 7, 500 } })), 3);
  }
}

TEST_F(VtkStreamingDistance, CanBeAborted)
{
  expectCanBeAborted(this->Distance.Get(), this->Folder);
}

TEST_F(VtkStreamingDistance, PointsOfNoCellAreNotReached)
{
  this->Distance->SourceOn();
  const IsolatedVertices loose = writtenAtLoosePoints(this->Folder, *this->Reader, *this->Distance);
  for (const ColumnSpec& spec : distanceColumns({ .from = {}, .source = true }))
  {
    const std::ptrdiff_t column = findColumn(loose.columns, spec);
    ASSERT_GE(column, 0) << spec.name;
    for (std::size_t i = 0; i < 2; ++i)
    {
      EXPECT_EQ(loose.columns[static_cast<std::size_t>(column)].value(i),
        spec.name == DistanceName ? HUGE_VAL : -1);
    }
  }
}

TEST_F(VtkStreamingDistance, PointsOfNoCellOfAnOrdinaryMeshAreNotReached)
{
  vtkNew<vtkPolyData> mesh;
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> triangles;
  for (const auto& [x, y] : { std::pair(9.0, 9.0), { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } })
  {
    points->InsertNextPoint(x, y, 0.0);
  }
  const vtkIdType corners[] = { 1, 2, 3 };
  triangles->InsertNextCell(3, corners);
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  this->Distance->SetInputData(mesh);
  this->Distance->SetFrom(R"({"nearest": [[0, 0, 0]]})");
  this->Distance->SourceOn();
  this->Distance->DirectionOn();
  ASSERT_TRUE(updatePiece(this->Distance, 0, 1));
  vtkPointData* found = this->output()->GetPointData();
  EXPECT_EQ(found->GetArray(DistanceName)->GetComponent(0, 0), HUGE_VAL);
  EXPECT_EQ(found->GetArray(DistanceSourceName)->GetComponent(0, 0), -1.0);
  EXPECT_EQ(found->GetArray(DistanceDirectionName)->GetComponent(0, 0), 0.0);
  EXPECT_EQ(found->GetArray(DistanceName)->GetComponent(2, 0), 1.0);
}

TEST_F(VtkStreamingDistance, ShortestPathsArePolylines)
{
  DistanceDescription description = from(Region(Region::Vertices{ { 7 } }));
  description.to = { Region(Region::Vertices{ { 500, 1200 } }) };
  const auto expected = distance(MemoryMesh(this->Mesh), description);
  const std::vector<Report::Path>& found = expected->report().distance->paths;
  this->Distance->SetTo(R"({"vertices": [500, 1200]})");
  const auto paths = [this]
  {
    return vtkPolyData::SafeDownCast(
      this->Distance->GetOutputDataObject(vtkStreamingDistance::PATHS));
  };
  for (const int pulled : { 0, 3 })
  {
    this->Distance->SetNumberOfPieces(pulled);
    ASSERT_TRUE(updatePiece(this->Distance, 0, 1));
    ASSERT_EQ(paths()->GetNumberOfLines(), 2);
    for (vtkIdType k = 0; k < 2; ++k)
    {
      const Report::Path& path = found[static_cast<std::size_t>(k)];
      EXPECT_EQ(paths()->GetCellData()->GetArray("To")->GetTuple1(k), path.to);
      EXPECT_EQ(paths()->GetCellData()->GetArray("From")->GetTuple1(k), 7);
      EXPECT_EQ(paths()->GetCellData()->GetArray("Length")->GetTuple1(k), path.length);
      vtkPoints* points = paths()->GetCell(k)->GetPoints();
      ASSERT_EQ(points->GetNumberOfPoints(), std::ssize(path.points));
      for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
      {
        std::array<double, 3> point;
        points->GetPoint(i, point.data());
        EXPECT_EQ(point, path.points[static_cast<std::size_t>(i)]);
      }
    }
  }
  this->Distance->SetTo("");
  ASSERT_TRUE(updatePiece(this->Distance, 0, 1));
  EXPECT_EQ(paths()->GetNumberOfLines(), 0);
}

TEST_F(VtkStreamingDistance, ThePassesAreATable)
{
  ASSERT_TRUE(updatePiece(this->Distance, 0, 1));
  auto* table = vtkTable::SafeDownCast(this->Distance->GetOutputDataObject(1));
  ASSERT_TRUE(table);
  ASSERT_GT(this->Distance->GetPasses(), 0);
  ASSERT_EQ(table->GetNumberOfRows(), this->Distance->GetPasses());
  EXPECT_EQ(
    table->GetValueByName(table->GetNumberOfRows() - 1, "Residual").ToDouble(), 0.0); // settled
}

/** A filter between has the neighbours of its pieces, but not more of the mesh. */
TEST_F(VtkStreamingDistance, SaysThatAFilterBetweenLacksMoreThanNeighbours)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Distance->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
  const vtkNew<vtkElevationFilter> byPoint;
  const vtkNew<vtkCurvatures> byNeighbours;
  const vtkNew<vtkSmoothPolyDataFilter> byMore;
  Errors warnings(this->Distance);
  const auto notes = [&](vtkAlgorithm* between)
  {
    between->SetInputConnection(this->Reader->GetOutputPort());
    this->Distance->SetInputConnection(between->GetOutputPort());
    EXPECT_TRUE(streamPiece(this->Distance, 0, 1));
    return std::string(this->Distance->GetNotes());
  };
  EXPECT_EQ(notes(byPoint).find("Elevation"), std::string::npos);
  EXPECT_EQ(notes(byNeighbours).find("Curvatures"), std::string::npos);
  EXPECT_EQ(warnings.text(), "");
  const char* const sentence = "in pieces through Smooth Poly Data Filter, and two pieces differ";
  EXPECT_NE(notes(byMore).find(sentence), std::string::npos);
  EXPECT_NE(warnings.text().find(sentence), std::string::npos);
}

TEST_F(VtkStreamingDistance, MistakesAreOneErrorEach)
{
  Errors errors(this->Distance);
  const auto expect = [&](const std::string& words, const std::function<void()>& spoil)
  {
    for (const int pulled : { 0, 3 })
    {
      errors.clear();
      this->Distance->SetNumberOfPieces(pulled);
      spoil();
      EXPECT_FALSE(updatePiece(this->Distance, 0, 1));
      EXPECT_TRUE(errors.contain(words)) << errors.text();
      this->Distance->SetFrom(R"({"vertices": [7]})");
      this->Distance->WallOff();
    }
  };
  expect("Nothing says where the distance is 0", [&] { this->Distance->SetFrom(nullptr); });
  expect("From: sphere: must be", [&] { this->Distance->SetFrom(R"({"sphere": [1]})"); });
  expect("from[0]: no vertex", [&] { this->Distance->SetFrom(R"({"sphere": [9, 9, 9, 1]})"); });
  this->Reader->SetMaximumPointsInMemory(100);
  this->Distance->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  expect("This is about the preview", [&] { this->Distance->SetFrom(R"({"vertices": [7000]})"); });
  this->Reader->SetMaximumPointsInMemory(2000000);
  expect("Missing", [&] { this->Distance->SetFrom(R"({"mask": "Missing"})"); });
  this->Distance->SetTo("{");
  expect("To: ", [] {});
  this->Distance->SetTo(R"({"sphere": [9, 9, 9, 1]})");
  expect("to[0]: no vertex", [] {});
  this->Distance->SetTo(nullptr);
  expect("tetrahedral mesh", [&] { this->Distance->WallOn(); });
}

} // namespace
} // namespace smg::testing
