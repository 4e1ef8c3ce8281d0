// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkMeshHandle.h"
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Distance.h"
#include "smg/Smooth.h"

#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace smg::testing
{
namespace
{

/** Regions of a mesh with columns of every kind. */
class VtkMeshRegion : public ::testing::Test
{
protected:
  VtkMeshRegion()
  {
    this->open(describedMesh(tetBox(7, 6, 5, 0.1)));
    this->Region->SetInputConnection(this->Reader->GetOutputPort());
    this->Region->SetNumberOfPieces(5);
  }

  void open(StreamMesh mesh)
  {
    this->Mesh = std::move(mesh);
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    writeMesh(this->Folder / name, this->Mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
  }

  static vtkPointData& pointsOf(vtkAlgorithm* filter)
  {
    return *vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0))->GetPointData();
  }

  /** The values of an array at all vertices, piece by piece. */
  std::vector<double> values(vtkAlgorithm* filter, int pieces, const char* name) const
  {
    std::vector<double> values(static_cast<std::size_t>(this->Mesh.vertices()), -1.0);
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(filter, piece, pieces));
      vtkPointData& points = pointsOf(filter);
      vtkDataArray* array = points.GetArray(name);
      EXPECT_TRUE(array) << name;
      for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
      {
        const auto id = static_cast<std::size_t>(points.GetGlobalIds()->GetTuple1(i));
        const double value = array->GetTuple1(i);
        EXPECT_TRUE(values[id] == -1.0 || values[id] == value) << "pieces differ at " << id;
        values[id] = value;
      }
    }
    return values;
  }

  /** Expects that distances from the region, and its points, are those from `where`, whatever the
   * pieces. */
  void expectRegion(const std::vector<Where>& where)
  {
    DistanceDescription description;
    description.from = where;
    const Eigen::MatrixXd expected = valuesOf(*distance(MemoryMesh(this->Mesh), description));
    const vtkNew<vtkStreamingDistance> measured;
    measured->SetInputConnection(this->Last->GetOutputPort());
    measured->SetNumberOfPieces(4);
    for (const int pulled : { 0, 3 })
    {
      measured->SetNumberOfPieces(pulled);
      for (const int pieces : { 1, 2, 7 })
      {
        const std::vector<double> distances = this->values(measured, pieces, DistanceName);
        const std::vector<double> region = this->values(this->Last, pieces, "RegionMask");
        for (std::size_t v = 0; v < distances.size(); ++v)
        {
          ASSERT_EQ(distances[v], expected(static_cast<Eigen::Index>(v), 0)) << v;
          ASSERT_EQ(region[v], distances[v] == 0.0 ? 1.0 : 0.0) << v;
        }
      }
    }
  }

  /** The point with this number in the original file. */
  std::array<double, 3> pointOf(std::int64_t id) const
  {
    std::size_t place = static_cast<std::size_t>(id);
    for (const Column& column : this->Mesh.vertexColumns)
    {
      if (column.spec.name == OriginalIdName)
      {
        const auto ids = column.as<std::int64_t>();
        place = static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
      }
    }
    const double* p = &this->Mesh.positions[3 * place];
    return { p[0], p[1], p[2] };
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkMeshRegion> Region;
  vtkRegionFilter* Last = this->Region.Get(); ///< of the chain
};

TEST_F(VtkMeshRegion, BoundaryOfASolid)
{
  this->Region->SetRegion(vtkMeshRegion::BOUNDARY);
  this->expectRegion({ OnBoundary{} });
}

TEST_F(VtkMeshRegion, BoundaryOfASurface)
{
  this->open(describedMesh(shuffled(grid(23, 17))));
  this->Region->SetRegion(vtkMeshRegion::BOUNDARY);
  this->expectRegion({ OnBoundary{} });
}

TEST_F(VtkMeshRegion, AMaskOfPointsOrCells)
{
  this->Region->SetRegion(vtkMeshRegion::MASK);
  for (const char* array : { "mask", "cellMask" })
  {
    this->Region->SetMaskArray(array);
    this->expectRegion({ ColumnMask{ array } });
  }
}

TEST_F(VtkMeshRegion, ATagOfPointsOrCells)
{
  this->Region->SetRegion(vtkMeshRegion::TAG);
  for (const auto& [array, tag] : { std::pair("mask", 0.0), std::pair("tag", 3.0) })
  {
    this->Region->SetTagArray(array);
    this->Region->SetTag(tag);
    this->expectRegion({ ColumnTag{ array, tag } });
  }
}

TEST_F(VtkMeshRegion, OneNameIsAUnionOfRegions)
{
  const vtkNew<vtkMeshRegion> second, third;
  second->SetInputConnection(this->Region->GetOutputPort());
  third->SetInputConnection(second->GetOutputPort());
  this->Region->SetRegion(vtkMeshRegion::IDS);
  this->Region->AddId(3);
  second->SetRegion(vtkMeshRegion::TAG);
  second->SetTagArray("tag");
  second->SetTag(3);
  third->SetRegion(vtkMeshRegion::POINTS);
  third->AddPoint(6, 5, 4);
  this->Last = third;
  // What filters mark are regions, also of single points: as balls, not as points by their names.
  const auto ballAround = [this](const std::array<double, 3>& p)
  {
    std::array<double, 3> nearest{};
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < this->Mesh.positions.size(); k += 3)
    {
      const double* q = &this->Mesh.positions[k];
      const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      nearest = distance < least ? std::array{ q[0], q[1], q[2] } : nearest;
      least = std::min(least, distance);
    }
    return smg::Region(smg::Region::Sphere{ nearest, 1e-9 });
  };
  const std::vector<Where> where{ ballAround(this->pointOf(3)), ColumnTag{ "tag", 3 },
    ballAround({ 6, 5, 4 }) };
  this->expectRegion(where);

  // With other names, each is a region by itself, and the distance is that from all.
  second->SetRegionName("Second");
  third->SetRegionName("Third");
  const vtkNew<vtkStreamingDistance> measured;
  measured->SetInputConnection(third->GetOutputPort());
  const Eigen::MatrixXd expected =
    valuesOf(*distance(MemoryMesh(this->Mesh), DistanceDescription{ .from = where }));
  const std::vector<double> distances = this->values(measured, 3, DistanceName);
  for (std::size_t v = 0; v < distances.size(); ++v)
  {
    ASSERT_EQ(distances[v], expected(static_cast<Eigen::Index>(v), 0));
  }
  for (const char* name : { "RegionMask", "Second", "Third" })
  {
    EXPECT_TRUE(pointsOf(measured).HasArray(name)) << name;
  }
}

TEST_F(VtkMeshRegion, IsHeldBySmoothing)
{
  this->Region->SetRegion(vtkMeshRegion::BOUNDARY);
  Smoothing options;
  options.column = "one";
  options.hold = { OnBoundary{}, ColumnMask{ "mask" } };
  const Eigen::MatrixXd expected = valuesOf(*smooth(MemoryMesh(this->Mesh), options, options));
  const vtkNew<vtkStreamingMeshSmoothing> smoothing;
  smoothing->SetInputConnection(this->Region->GetOutputPort());
  smoothing->SetColumn("one");
  smoothing->SetHold(R"({"mask": "mask"})");
  smoothing->SetNumberOfPieces(4);
  for (const int pulled : { 0, 3 })
  {
    smoothing->SetNumberOfPieces(pulled);
    const std::vector<double> smoothed = this->values(smoothing, 1, "one");
    for (std::size_t v = 0; v < smoothed.size(); ++v)
    {
      ASSERT_EQ(smoothed[v], expected(static_cast<Eigen::Index>(v), 0));
    }
  }
}

TEST_F(VtkMeshRegion, IsSearchedOnceAsLongAsTheMeshIsTheSame)
{
  const vtkNew<vtkMeshHandle> first, second;
  first->SetInputConnection(this->Reader->GetOutputPort());
  first->SetRegion(vtkMeshHandle::EVERYWHERE);
  second->SetInputConnection(first->GetOutputPort());
  second->SetRegion(vtkMeshHandle::BOUNDARY);
  second->SetNumberOfPieces(20);
  int reads = 0;
  const vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&reads);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* number, void*) { ++*static_cast<int*>(number); });
  this->Reader->AddObserver(vtkCommand::StartEvent, count);
  ASSERT_TRUE(updatePiece(second, 0, 3));
  EXPECT_GT(reads, 20);
  reads = 0;
  // The motion of a handle before it changes nothing.
  first->SetMotion(vtkMeshHandle::SIMILARITY);
  for (int piece = 0; piece < 3; ++piece)
  {
    ASSERT_TRUE(updatePiece(second, piece, 3));
  }
  EXPECT_LE(reads, 6);
}

/** As those of saved results, whose field data no longer name the regions. */
TEST_F(VtkMeshRegion, TheArrayOfNoRegionIsReplaced)
{
  this->Region->SetRegion(vtkMeshRegion::IDS);
  this->Region->AddId(3);
  const vtkNew<vtkMeshRegion> second;
  second->SetInputConnection(this->Region->GetOutputPort());
  second->SetRegion(vtkMeshRegion::IDS);
  second->AddId(8);
  this->Last = second;
  for (const bool isTaken : { true, false, true })
  {
    const char* name = isTaken ? "mask" : "RegionMask";
    const std::string replaced = "The array mask of the input, which no Mesh Region before";
    Errors warnings(this->Region);
    const Errors ofSecond(second);
    for (vtkMeshRegion* region : { this->Region.Get(), second.Get() })
    {
      region->SetRegionName(name);
    }
    ASSERT_TRUE(updatePiece(second, 0, 1));
    vtkPointData* points = vtkPointSet::SafeDownCast(second->GetOutput())->GetPointData();
    double marked = 0.0;
    for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
    {
      marked += points->GetArray(name)->GetTuple1(i);
    }
    EXPECT_EQ(marked, 2.0) << name;
    EXPECT_EQ(warnings.contain(replaced), isTaken) << warnings.text();
    EXPECT_EQ(ofSecond.text(), "");
  }
}

TEST_F(VtkMeshRegion, MistakesAreOneErrorEach)
{
  Errors errors(this->Region);
  const auto expect = [&](const std::string& words, const std::function<void()>& spoil)
  {
    errors.clear();
    spoil();
    EXPECT_FALSE(updatePiece(this->Region, 0, 1));
    EXPECT_TRUE(errors.contain(words)) << errors.text();
  };
  const auto set = [this](int region) { this->Region->SetRegion(region); };
  expect("no mask array: choose MaskArray", [&] { set(vtkMeshRegion::MASK); });
  expect("no tag array: choose TagArray", [&] { set(vtkMeshRegion::TAG); });
  set(vtkMeshRegion::MASK);
  expect("Missing", [&] { this->Region->SetMaskArray("Missing"); });
  expect("has 3 components", [&] { this->Region->SetMaskArray("three"); });
  expect("not a number", [&] { this->Region->SetMaskArray("nan"); });
  set(vtkMeshRegion::EVERYWHERE);
  expect(
    "not that of a Mesh Region before this one", [&] { this->Region->SetRegionName("three"); });
  expect("has no name", [&] { this->Region->SetRegionName(""); });
  this->Region->SetRegionName("RegionMask");
  expect("holds nothing",
    [&]
    {
      this->open(describedMesh(torus(12, 8, 0.2)));
      set(vtkMeshRegion::BOUNDARY);
    });
  ASSERT_FALSE(updatePiece(this->Region, 0, 1));
}

} // namespace
} // namespace smg::testing
