// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/MeshPieceData.h"
#include "Testing/Filters/MeshHandleFixture.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <cmath>
#include <set>

namespace smg::testing
{
namespace
{

class VtkMeshHandleSelection : public VtkMeshHandle
{
protected:
  VtkMeshHandleSelection()
  {
    this->Handle->SetRegion(vtkMeshHandle::SELECTION);
    this->Handle->SetNumberOfPieces(6);
  }

  /** Selects by a list of numbers: ids, locations or ranges. */
  template <class Array>
  void select(int content, int field, const std::vector<double>& numbers, int components = 1)
  {
    vtkNew<Array> list;
    list->SetNumberOfComponents(components);
    for (const double number : numbers)
    {
      list->InsertNextValue(number);
    }
    vtkNew<vtkSelectionNode> node;
    node->SetContentType(content);
    node->SetFieldType(field);
    node->SetSelectionList(list);
    this->Selection->RemoveAllNodes();
    this->Selection->AddNode(node);
    this->Handle->SetInputDataObject(1, this->Selection);
  }

  /** The held points of the displayed mesh, the same for all numbers of pieces. */
  std::vector<std::int64_t> heldAlike()
  {
    const HandleUnion whole = collectWhole(this->Handle);
    EXPECT_EQ(collectStreamed(this->Handle, 7), whole);
    EXPECT_EQ(collectPieces(this->Handle, 3), whole);
    return whole.heldIds();
  }

  vtkPolyData* displayed()
  {
    return vtkPolyData::SafeDownCast(this->Handle->GetOutputDataObject(0));
  }

  vtkNew<vtkSelection> Selection;
};

TEST_F(VtkMeshHandleSelection, HoldsPointsOfEveryKind)
{
  using Ids = std::vector<std::int64_t>;
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::POINT, { 1500, 4, 77 });
  EXPECT_EQ(this->heldAlike(), (Ids{ 4, 77, 1500 }));
  this->select<vtkIdTypeArray>(
    vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT, { 1501, 4, 78 });
  EXPECT_EQ(this->heldAlike(), (Ids{ 4, 78, 1501 }));

  const double* place = this->positionOf(321);
  this->select<vtkDoubleArray>(vtkSelectionNode::LOCATIONS, vtkSelectionNode::POINT,
    { place[0] + 1e-4, place[1], place[2] }, 3);
  this->Selection->GetNode(0)->GetProperties()->Set(vtkSelectionNode::EPSILON(), 0.01);
  EXPECT_EQ(this->heldAlike(), Ids{ 321 });

  this->select<vtkDoubleArray>(
    vtkSelectionNode::THRESHOLDS, vtkSelectionNode::POINT, { 10.0, 20.0 }, 2);
  this->Selection->GetNode(0)->GetSelectionList()->SetName("OriginalId");
  Ids expected;
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    if (this->Mesh.originalIds[v] >= 10 && this->Mesh.originalIds[v] <= 20)
    {
      expected.push_back(v);
    }
  }
  EXPECT_EQ(this->heldAlike(), expected);

  // The part of the half-space of positive x that is seen along -z: left to right, low to high,
  // near to far.
  std::vector<double> corners;
  for (const double x : { 0.0, 10.0 })
  {
    for (const double y : { -10.0, 10.0 })
    {
      for (const double z : { 10.0, -10.0 })
      {
        corners.insert(corners.end(), { x, y, z, 1.0 });
      }
    }
  }
  this->select<vtkDoubleArray>(vtkSelectionNode::FRUSTUM, vtkSelectionNode::POINT, corners, 4);
  expected.clear();
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    if (this->positionOf(v)[0] > 0.0)
    {
      expected.push_back(v);
    }
  }
  EXPECT_EQ(this->heldAlike(), expected);
}

TEST_F(VtkMeshHandleSelection, HoldsThePointsOfCells)
{
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::CELL, { 0, 3000 });
  std::set<std::int64_t> expected;
  for (const std::int64_t cell : { 0, 3000 })
  {
    expected.insert(
      this->Mesh.corners.begin() + 3 * cell, this->Mesh.corners.begin() + 3 * cell + 3);
  }
  EXPECT_EQ(this->heldAlike(), std::vector<std::int64_t>(expected.begin(), expected.end()));
}

TEST_F(VtkMeshHandleSelection, HoldsWhatIsAroundAndMovesItToTargets)
{
  this->select<vtkIdTypeArray>(vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT, { 900, 5 });
  this->Handle->SetRadius(0.3);
  this->Handle->SetRings(1);
  EXPECT_EQ(this->heldAlike(), influenced(this->Mesh, { 5, 900 }, { 0.3, 1 }));
  this->Handle->AddPointTarget(0.0, 0.0, 7.0);
  this->Handle->AddPointTarget(0.0, 0.0, 8.0);
  this->heldAlike();
  const HandleUnion held = collectWhole(this->Handle);
  EXPECT_EQ(held.values.at(5).target[2], 7.0);
  EXPECT_EQ(held.values.at(900).target[2], 8.0);
}

TEST_F(VtkMeshHandleSelection, OnThePreviewHoldsWhatTheSelectedPointsStandFor)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  this->Reader->Update();
  ASSERT_TRUE(isPreview(*vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0))));
  this->select<vtkIdTypeArray>(
    vtkSelectionNode::INDICES, vtkSelectionNode::POINT, { 0, 17, 18, 100 });
  const HandleUnion displayed = collectWhole(this->Handle);
  const std::vector<std::int64_t> selected = displayed.heldIds();
  ASSERT_EQ(selected.size(), 4U);

  vtkPolyData* preview = this->displayed();
  double sum = 0.0;
  for (vtkIdType c = 0; c < preview->GetNumberOfCells(); ++c)
  {
    vtkPoints* corners = preview->GetCell(c)->GetPoints();
    for (vtkIdType k = 0; k < 3; ++k)
    {
      double a[3], b[3];
      corners->GetPoint(k, a);
      corners->GetPoint((k + 1) % 3, b);
      sum += std::sqrt(PointTree::squaredDistance(a, b)) / 3.0;
    }
  }
  const double radius = sum / double(preview->GetNumberOfCells()) / std::sqrt(3.0);
  const HandleUnion streamed = collectStreamed(this->Handle, 7);
  EXPECT_EQ(streamed.heldIds(), influenced(this->Mesh, selected, { radius, 0 }));
  EXPECT_GT(streamed.held(), 12);
  EXPECT_EQ(collectStreamed(this->Handle, 2), streamed);
  EXPECT_EQ(this->Handle->GetNumberOfHeldPoints(), streamed.held());
  // The displayed data is displayed again.
  EXPECT_EQ(collectWhole(this->Handle), displayed);

  this->Handle->SetRadius(0.0);
  EXPECT_EQ(collectStreamed(this->Handle, 7).heldIds(), selected);
  this->Handle->SetRings(2);
  EXPECT_EQ(collectStreamed(this->Handle, 7).heldIds(), influenced(this->Mesh, selected, { 0, 2 }));
}

/** Numbers are those of what is shown when the selection is applied. */
TEST_F(VtkMeshHandleSelection, StaysInItsPlaceWhenTheMeshIsShownOtherwise)
{
  this->Reader->SetMaximumPointsInMemory(100);
  for (const auto& [field, radius] : { std::pair(vtkSelectionNode::POINT, -1.0),
         std::pair(vtkSelectionNode::POINT, 0.0), std::pair(vtkSelectionNode::CELL, -1.0) })
  {
    this->Handle->SetRadius(radius);
    this->Reader->SetPreviewPoints(300);
    this->Reader->SetMaximumPointsInMemory(100);
    this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, field, { 0, 17, 18, 100 });
    const HandleUnion onPreview = collectWhole(this->Handle);
    const HandleUnion onMesh = collectStreamed(this->Handle, 7);
    this->Reader->SetPreviewPoints(500);
    const HandleUnion onFiner = collectWhole(this->Handle);
    ASSERT_GT(vtkPointSet::SafeDownCast(this->displayed())->GetNumberOfPoints(), 400);
    for (const std::int64_t id : onFiner.heldIds())
    {
      EXPECT_TRUE(onMesh.values.at(id).mask) << id;
    }
    EXPECT_GT(onFiner.held(), 0);
    EXPECT_EQ(collectStreamed(this->Handle, 7), onMesh);
    this->Reader->SetMaximumPointsInMemory(1000000);
    EXPECT_EQ(collectWhole(this->Handle), onMesh);
    EXPECT_EQ(collectStreamed(this->Handle, 7), onMesh);
    // As it was shown first.
    this->Reader->SetMaximumPointsInMemory(100);
    this->Reader->SetPreviewPoints(300);
    EXPECT_EQ(collectWhole(this->Handle), onPreview);
  }

  // From the whole mesh to a preview.
  this->Handle->SetRadius(-1.0);
  this->Reader->SetMaximumPointsInMemory(1000000);
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::POINT, { 4, 77, 1500 });
  const HandleUnion onMesh = collectWhole(this->Handle);
  this->Reader->SetMaximumPointsInMemory(100);
  EXPECT_EQ(collectWhole(this->Handle).held(), 3);
  EXPECT_EQ(collectStreamed(this->Handle, 7), onMesh);
}

TEST_F(VtkMeshHandleSelection, OnThePreviewGlobalIdsArePointsOfTheMesh)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  const std::vector<std::int64_t> ids{ 5, 6, 7, 8, 900 };
  this->select<vtkIdTypeArray>(vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT,
    std::vector<double>(ids.rbegin(), ids.rend()));
  this->Selection->SetExpression(this->Selection->GetNodeNameAtIndex(0));
  EXPECT_EQ(collectStreamed(this->Handle, 7).heldIds(), ids);
  EXPECT_GT(collectWhole(this->Handle).held(), 0);
  ASSERT_TRUE(isPreview(*this->displayed()));
  const HandleUnion displayed = collectWhole(this->Handle);

  // The same as Region Ids.
  vtkNew<vtkMeshHandle> byIds;
  this->prepare(byIds, this->Reader);
  byIds->SetRegion(vtkMeshHandle::IDS);
  for (const std::int64_t id : ids)
  {
    byIds->AddId(id);
  }
  EXPECT_EQ(collectWhole(byIds), displayed);
  this->Handle->SetRings(2);
  EXPECT_EQ(collectStreamed(this->Handle, 7).heldIds(), influenced(this->Mesh, ids, { 0, 2 }));
}

TEST_F(VtkMeshHandleSelection, WhatGlobalIdsExcludeIsNotHeld)
{
  const std::vector<double> numbers{ 4, 77 };
  this->select<vtkIdTypeArray>(vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT, numbers);
  this->Selection->GetNode(0)->GetProperties()->Set(vtkSelectionNode::INVERSE(), 1);
  EXPECT_EQ(this->heldAlike().size(), std::size_t(this->Mesh.vertices() - 2));
  this->select<vtkIdTypeArray>(vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT, numbers);
  this->Selection->SetExpression("!" + this->Selection->GetNodeNameAtIndex(0));
  EXPECT_EQ(this->heldAlike().size(), std::size_t(this->Mesh.vertices() - 2));
}

TEST_F(VtkMeshHandleSelection, OnThePreviewWorksBehindOtherHandles)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::POINT, { 0, 50 });
  vtkNew<vtkMeshHandle> first;
  this->prepare(first, this->Reader);
  vtkNew<vtkMeshHandle> between;
  this->prepare(between, first);
  between->SetRegion(vtkMeshHandle::SELECTION);
  between->SetInputDataObject(1, this->Selection);
  this->Handle->SetInputConnection(between->GetOutputPort());
  this->Handle->SetMotion(vtkMeshHandle::SIMILARITY);
  this->Handle->SetScale(3.0);
  const HandleUnion streamed = collectStreamed(this->Handle, 4);
  int twice = 0;
  for (const auto& [id, value] : streamed.values)
  {
    const int ball = this->isInBall(id) ? 1 : 0;
    EXPECT_TRUE(value.mask == ball || value.mask == ball + 2);
    EXPECT_EQ(value.logScale, value.mask >= 2 ? std::log(3.0) : 0.0);
    twice += value.mask >= 2;
  }
  EXPECT_GT(twice, 4);
  EXPECT_EQ(collectWhole(this->Handle).held() > 0, true);
}

TEST_F(VtkMeshHandleSelection, ASelectionOfNothingIsAnError)
{
  Errors errors(this->Handle);
  this->Handle->SetInputDataObject(1, this->Selection);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("is empty")) << errors.text();
  errors.clear();
  this->select<vtkDoubleArray>(
    vtkSelectionNode::LOCATIONS, vtkSelectionNode::POINT, { 99.0, 0.0, 0.0 }, 3);
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("selects no point")) << errors.text();
  errors.clear();
  EXPECT_EQ(streamPiece(this->Handle, 0, 3), 0);
  EXPECT_TRUE(errors.contain("selects no point")) << errors.text();
  errors.clear();
  this->select<vtkIdTypeArray>(vtkSelectionNode::GLOBALIDS, vtkSelectionNode::POINT, { 4, 99999 });
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("no point with the id 99999")) << errors.text();
  errors.clear();
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::ROW, { 1 });
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("neither points nor cells")) << errors.text();
  errors.clear();
  this->select<vtkIdTypeArray>(vtkSelectionNode::QUERY, vtkSelectionNode::POINT, { 1 });
  EXPECT_EQ(updatePiece(this->Handle, 0, 1), 0);
  EXPECT_TRUE(errors.contain("is a query")) << errors.text();
}

TEST_F(VtkMeshHandleSelection, AnotherSelectionHoldsOtherPoints)
{
  this->select<vtkIdTypeArray>(vtkSelectionNode::INDICES, vtkSelectionNode::POINT, { 7 });
  EXPECT_EQ(this->heldAlike(), std::vector<std::int64_t>{ 7 });
  auto* list = vtkIdTypeArray::SafeDownCast(this->Selection->GetNode(0)->GetSelectionList());
  list->SetValue(0, 8);
  list->Modified();
  this->Selection->GetNode(0)->Modified();
  EXPECT_EQ(this->heldAlike(), std::vector<std::int64_t>{ 8 });
}

} // namespace
} // namespace smg::testing
