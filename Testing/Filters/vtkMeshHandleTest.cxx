// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/MeshPieceData.h"
#include "Testing/Filters/MeshHandleFixture.h"

#include "vtkPlane.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"

#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

TEST_F(VtkMeshHandle, HoldsAFunctionsInsideInPiecesAsInTheWhole)
{
  const HandleUnion whole = collectWhole(this->Handle);
  ASSERT_EQ(std::int64_t(whole.values.size()), this->Mesh.vertices());
  for (const auto& [id, value] : whole.values)
  {
    EXPECT_EQ(value.mask, this->isInBall(id) ? 1 : 0);
    if (value.mask)
    {
      EXPECT_TRUE(std::equal(value.target.begin(), value.target.end(), this->positionOf(id)));
    }
    EXPECT_EQ(value.rotation, (std::array<double, 3>{}));
    EXPECT_EQ(value.logScale, 0.0);
  }
  EXPECT_GT(this->Handle->GetNumberOfHeldPoints(), 100);
  EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), whole.held());
  for (const int pieces : { 1, 2, 7, 64 })
  {
    EXPECT_EQ(collectStreamed(this->Handle, pieces), whole);
    EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), whole.held());
    EXPECT_EQ(collectPieces(this->Handle, pieces), whole);
  }
  this->Handle->InsideOutOn();
  EXPECT_EQ(collectWhole(this->Handle).held(), this->Mesh.vertices() - whole.held());
}

TEST_F(VtkMeshHandle, OfSeveralHandlesTheLastOneCounts)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-1.0, 0.0, 0.0);
  vtkNew<vtkMeshHandle> second;
  this->prepare(second, this->Handle);
  second->SetRegionFunction(plane);
  second->SetMotion(vtkMeshHandle::SIMILARITY);
  second->SetTranslation(0.0, 5.0, 0.0);
  second->SetScale(2.0);
  this->Ball->SetCenter(0.0, 2.0, 0.0);
  std::array<int, 3> counts{};
  for (const auto& [id, value] : collectWhole(second).values)
  {
    const double* point = this->positionOf(id);
    const bool isSecond = point[0] >= 0.0;
    const int expected = int(isSecond) + int(this->isInBall(id));
    ASSERT_EQ(value.mask, expected);
    ++counts[expected];
    EXPECT_EQ(value.logScale, isSecond ? std::log(2.0) : 0.0);
    if (isSecond)
    {
      EXPECT_EQ(value.target[1], 2.0 * point[1] + 5.0);
    }
    else if (expected == 1)
    {
      EXPECT_EQ(value.target[1], point[1]);
    }
  }
  EXPECT_TRUE(counts[0] > 0 && counts[1] > 0 && counts[2] > 0);
}

TEST_F(VtkMeshHandle, CountsNoMoreThan255Handles)
{
  vtkNew<vtkFaultyFilter> busy;
  busy->SetInputConnection(this->Reader->GetOutputPort());
  busy->Spoil = [](vtkPointSet* mesh, int)
  {
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName("HandleMask");
    mask->SetNumberOfTuples(mesh->GetNumberOfPoints());
    mask->Fill(255);
    mesh->GetPointData()->AddArray(mask);
  };
  this->Handle->SetInputConnection(busy->GetOutputPort());
  for (const auto& [id, value] : collectWhole(this->Handle).values)
  {
    EXPECT_EQ(value.mask, 255);
  }
}

TEST_F(VtkMeshHandle, TurnsGrowsAndMoves)
{
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  this->Handle->SetRotationAxis(0.0, 3.0, 0.0);
  this->Handle->SetRotationAngle(450.0);
  this->Handle->SetCenter(1.0, 0.0, 0.0);
  this->Handle->SetScale(2.0);
  this->Handle->SetTranslation(0.0, 0.0, 4.0);
  const HandleUnion similarity = collectWhole(this->Handle);
  for (const auto& [id, value] : similarity.values)
  {
    if (value.mask)
    {
      // 450 degrees about y: z goes to x, x to -z.
      const double* p = this->positionOf(id);
      EXPECT_NEAR(value.target[0], 1.0 + 2.0 * p[2], 1e-12);
      EXPECT_NEAR(value.target[1], 2.0 * p[1], 1e-12);
      EXPECT_NEAR(value.target[2], 4.0 - 2.0 * (p[0] - 1.0), 1e-12);
      EXPECT_NEAR(value.rotation[1], 2.5 * std::numbers::pi, 1e-12);
      EXPECT_NEAR(value.logScale, std::log(2.0), 1e-12);
    }
  }
  vtkNew<vtkTransform> transform;
  this->Handle->SetTransform(transform);
  this->Handle->SetMotion(vtkMeshHandle::TRANSFORM);
  const vtkMTimeType before = this->Handle->GetMTime();
  transform->Translate(1.0, 0.0, 4.0);
  transform->RotateY(90.0);
  transform->Scale(2.0, 2.0, 2.0);
  transform->Translate(-1.0, 0.0, 0.0);
  EXPECT_GT(this->Handle->GetMTime(), before);
  const HandleUnion transformed = collectWhole(this->Handle);
  for (const auto& [id, value] : transformed.values)
  {
    const HandleValue& other = similarity.values.at(id);
    ASSERT_EQ(value.mask, other.mask);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(value.target[k], other.target[k], 1e-12);
    }
    EXPECT_NEAR(value.rotation[1], value.mask ? 0.5 * std::numbers::pi : 0.0, 1e-12);
  }
}

TEST_F(VtkMeshHandle, OriginalIdsAreNeverDoubles)
{
  constexpr std::int64_t Beyond = std::int64_t(1) << 53; // of the next ones only each other
  StreamMesh mesh = toStream(torus(60, 30, 0.2));
  for (std::int64_t& id : mesh.originalIds)
  {
    id += Beyond;
  }
  addColumns(mesh);
  writeMesh(this->Folder / "beyond.vsm", mesh);
  this->Reader->SetFileName((this->Folder / "beyond.vsm").c_str());
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  this->Handle->SetIdType(vtkMeshHandle::ORIGINAL_IDS);
  const std::vector<std::int64_t> ids{ Beyond + 3, Beyond + 900, Beyond + 1701 };
  for (const std::int64_t id : ids)
  {
    this->Handle->AddId(id);
  }
  const HandleUnion whole = collectWhole(this->Handle);
  EXPECT_EQ(collectStreamed(this->Handle, 7), whole);
  std::vector<std::int64_t> held;
  for (const std::int64_t v : whole.heldIds())
  {
    held.push_back(mesh.originalIds[v]);
  }
  std::sort(held.begin(), held.end());
  EXPECT_EQ(held, ids);
}

TEST_F(VtkMeshHandle, HoldsIdsAndTheirSurroundings)
{
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  const std::vector<std::int64_t> ids{ 1700, 3, 900, 3 };
  for (const std::int64_t id : ids)
  {
    this->Handle->AddId(id);
  }
  const HandleUnion whole = collectWhole(this->Handle);
  EXPECT_EQ(whole.heldIds(), (std::vector<std::int64_t>{ 3, 900, 1700 }));
  EXPECT_EQ(collectStreamed(this->Handle, 7), whole);
  EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), 3);

  this->Handle->SetIdType(vtkMeshHandle::ORIGINAL_IDS);
  std::vector<std::int64_t> expected;
  for (const std::int64_t v : collectWhole(this->Handle).heldIds())
  {
    expected.push_back(this->Mesh.originalIds[v]);
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(expected, (std::vector<std::int64_t>{ 3, 900, 1700 }));

  this->Handle->SetIdType(vtkMeshHandle::GLOBAL_IDS);
  for (const auto& [radius, rings] : { std::pair(0.5, 0), std::pair(-1.0, 2), std::pair(0.3, 2) })
  {
    this->Handle->SetRadius(radius);
    this->Handle->SetRings(rings);
    const auto held = influenced(this->Mesh, ids, { std::max(0.0, radius), rings });
    EXPECT_GT(held.size(), 3U);
    const HandleUnion displayed = collectWhole(this->Handle);
    EXPECT_EQ(displayed.heldIds(), held);
    EXPECT_EQ(collectStreamed(this->Handle, 5), displayed);
  }
}

TEST_F(VtkMeshHandle, PointsGoToTheirTargetsWithWhatIsAroundThem)
{
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  this->Handle->SetScale(2.0);
  this->Handle->SetRadius(0.3);
  const std::array<std::int64_t, 2> vertices{ 70, 1500 };
  for (const std::int64_t v : vertices)
  {
    const double* p = this->positionOf(v);
    this->Handle->AddPoint(p[0] + 1e-3, p[1], p[2]);
    this->Handle->AddPointTarget(p[0], p[1] + double(v), p[2]);
  }
  const HandleUnion whole = collectWhole(this->Handle);
  for (const std::int64_t v : whole.heldIds())
  {
    const HandleValue& value = whole.values.at(v);
    const double* p = this->positionOf(v);
    const double moved = std::round(value.target[1] - p[1]);
    EXPECT_TRUE(moved == 70.0 || moved == 1500.0);
    EXPECT_NEAR(value.target[1], p[1] + moved, 1e-12);
    EXPECT_EQ(value.logScale, std::log(2.0));
  }
  EXPECT_GT(whole.held(), 4);
  for (const std::int64_t v : vertices)
  {
    EXPECT_EQ(whole.values.at(v).target[1], this->positionOf(v)[1] + double(v));
  }
  EXPECT_EQ(collectStreamed(this->Handle, 6), whole);
}

TEST_F(VtkMeshHandle, MovingKeepsWhatWasFound)
{
  vtkNew<vtkFaultyFilter> watched;
  watched->SetInputConnection(this->Reader->GetOutputPort());
  this->Handle->SetInputConnection(watched->GetOutputPort());
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->SetNumberOfPieces(8);
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  collectStreamed(this->Handle, 5);
  // The requested piece, the eight to inspect, the piece again, and the other four.
  EXPECT_EQ(watched->Requests.size(), 14U);
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  this->Handle->SetTranslation(1.0, 0.0, 0.0);
  collectStreamed(this->Handle, 5);
  EXPECT_EQ(watched->Requests.size(), 19U);
  this->Handle->SetRadius(0.5);
  collectStreamed(this->Handle, 5);
  EXPECT_EQ(watched->Requests.size(), 33U);
  this->Reader->Modified();
  collectStreamed(this->Handle, 5);
  EXPECT_EQ(watched->Requests.size(), 47U);
}

TEST_F(VtkMeshHandle, MovingTheHandlesBeforeKeepsWhatWasFound)
{
  vtkNew<vtkFaultyFilter> watched;
  watched->SetInputConnection(this->Reader->GetOutputPort());
  vtkNew<vtkMeshHandle> dragged;
  this->prepare(dragged, watched);
  dragged->SetMotion(vtkMeshHandle::SIMILARITY);
  vtkNew<vtkMeshHandle> between;
  this->prepare(between, dragged);
  this->Handle->SetInputConnection(between->GetOutputPort());
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  this->Handle->SetNumberOfPieces(8);
  this->Handle->AddId(1000);
  this->Handle->SetRings(1);
  const std::vector<std::int64_t> held = collectStreamed(this->Handle, 5).heldIds();
  // The requested piece, the eight to find the id and its surroundings, and the other four.
  EXPECT_EQ(watched->Requests.size(), 21U);
  watched->Requests.clear();
  dragged->SetTranslation(1.0, 0.0, 0.0);
  EXPECT_EQ(collectStreamed(this->Handle, 5).heldIds(), held);
  EXPECT_EQ(watched->Requests.size(), 5U);

  // The same holds where a preview is displayed.
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  collectWhole(this->Handle);
  watched->Requests.clear();
  dragged->SetTranslation(2.0, 0.0, 0.0);
  const HandleUnion displayed = collectWhole(this->Handle);
  EXPECT_EQ(watched->Requests, std::vector<std::string>{ "0/1" });
  EXPECT_GT(displayed.held(), 0);
}

TEST_F(VtkMeshHandle, ShowsIdsAndPointsOnThePreview)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  this->Handle->AddId(0);
  this->Handle->AddId(1000);
  const HandleUnion ids = collectWhole(this->Handle);
  EXPECT_LT(ids.values.size(), 301U);
  EXPECT_TRUE(isPreview(*vtkPointSet::SafeDownCast(this->Handle->GetOutputDataObject(0))));
  EXPECT_EQ(ids.held(), 2);
  EXPECT_EQ(collectStreamed(this->Handle, 4).heldIds(), (std::vector<std::int64_t>{ 0, 1000 }));
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  EXPECT_EQ(collectWhole(this->Handle).held(), 1);
  EXPECT_EQ(collectStreamed(this->Handle, 4).held(), 1);
}

TEST_F(VtkMeshHandle, HoldsPointsOfTetrahedra)
{
  this->open(tetBox(8, 8, 8, 0.1));
  this->Ball->SetCenter(0.0, 0.0, 0.0);
  this->Ball->SetRadius(4.0);
  const HandleUnion whole = collectWhole(this->Handle);
  EXPECT_GT(whole.held(), 30);
  EXPECT_EQ(collectStreamed(this->Handle, 5), whole);
  this->Handle->SetRegion(vtkMeshHandle::IDS);
  this->Handle->AddId(200);
  this->Handle->SetRings(1);
  EXPECT_EQ(collectWhole(this->Handle).heldIds(), influenced(this->Mesh, { 200 }, { 0.0, 1 }));
}

TEST_F(VtkMeshHandle, NeedsNoIdsForWhatIsDisplayed)
{
  vtkNew<vtkPolyData> plain;
  this->Reader->Update();
  auto* read = vtkPolyData::SafeDownCast(this->Reader->GetOutputDataObject(0));
  plain->SetPoints(read->GetPoints());
  plain->SetPolys(read->GetPolys());
  this->Handle->SetInputDataObject(plain);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  const vtkIdType held = this->Handle->GetNumberOfHeldPoints();
  EXPECT_GT(held, 100);
  this->Handle->SetRegion(vtkMeshHandle::POINTS);
  this->Handle->AddPoint(3.0, 0.0, 0.0);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 1);
  EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), 1);
}

} // namespace
} // namespace smg::testing
