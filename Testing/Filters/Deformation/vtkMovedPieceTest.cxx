// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Filters/DeformationFixture.h"

#include "vtkFloatArray.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkSignedCharArray.h"

#include <cmath>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using VtkMovedPiece = DeformationFixture;

TEST_F(VtkMovedPiece, PrecisionOfThePointsIsKept)
{
  StreamMesh mesh = this->Mesh;
  for (double& coordinate : mesh.positions)
  {
    coordinate = static_cast<float>(coordinate);
  }
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  vtkNew<vtkPolyData> single;
  single->DeepCopy(this->Reader->GetOutputDataObject(0));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->DeepCopy(single->GetPoints());
  single->SetPoints(points);
  this->Handles->SetInputDataObject(single);
  this->Deformation->SetNumberOfPieces(1);
  StreamMesh expected = this->deformed(mesh);
  for (double& coordinate : expected.positions)
  {
    coordinate = static_cast<float>(coordinate);
  }
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    this->collectPieces(1).expectEqual(expected);
    EXPECT_EQ(this->output()->GetPoints()->GetDataType(), VTK_FLOAT);
  }
}

/** The reader's mesh with normals that have the same values in every piece. */
class VtkMovedNormals : public DeformationFixture
{
protected:
  VtkMovedNormals()
  {
    this->Faulty->SetInputConnection(this->Reader->GetOutputPort());
    this->Faulty->Spoil = [](vtkPointSet* mesh, int)
    {
      const auto make = [](vtkIdType count)
      {
        auto normals = vtkSmartPointer<vtkFloatArray>::New();
        normals->SetName("Normals");
        normals->SetNumberOfComponents(3);
        normals->SetNumberOfTuples(count);
        normals->Fill(5.0);
        return normals;
      };
      mesh->GetPointData()->SetNormals(make(mesh->GetNumberOfPoints()));
      mesh->GetCellData()->AddArray(make(mesh->GetNumberOfCells()));
    };
    this->Handles->SetInputConnection(this->Faulty->GetOutputPort());
  }

  /** The normals of all points, or cells, by pieces. */
  std::map<std::int64_t, std::array<double, 3>> normals(int pieces, bool ofCells)
  {
    std::map<std::int64_t, std::array<double, 3>> all;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updatePiece(this->Deformation, piece, pieces));
      vtkPointSet* mesh = this->output();
      vtkDataArray* normals =
        ofCells ? mesh->GetCellData()->GetArray("Normals") : mesh->GetPointData()->GetNormals();
      vtkDataArray* ids = ofCells ? mesh->GetCellData()->GetArray("OriginalCellId")
                                  : mesh->GetPointData()->GetGlobalIds();
      for (vtkIdType i = 0; normals && i < normals->GetNumberOfTuples(); ++i)
      {
        std::array<double, 3> normal;
        normals->GetTuple(i, normal.data());
        const auto [entry, isNew] = all.emplace(std::int64_t(ids->GetTuple1(i)), normal);
        EXPECT_EQ(entry->second, normal);
      }
    }
    return all;
  }

  vtkNew<vtkFaultyFilter> Faulty;
};

TEST_F(VtkMovedNormals, AreThoseOfTheWholeDeformedMesh)
{
  const auto ofPoints = this->normals(1, false);
  const auto ofCells = this->normals(1, true);
  ASSERT_EQ(std::int64_t(ofPoints.size()), this->Mesh.vertices());
  ASSERT_EQ(std::int64_t(ofCells.size()), this->Mesh.cells());
  vtkNew<vtkPolyDataNormals> expected;
  expected->SetInputData(this->output());
  expected->SplittingOff();
  expected->ConsistencyOff();
  expected->ComputeCellNormalsOn();
  expected->Update();
  auto* other = expected->GetOutput()->GetPointData()->GetNormals();
  auto* otherCells = expected->GetOutput()->GetCellData()->GetNormals();
  for (const auto& [id, normal] : ofPoints)
  {
    // Weighted differently, so they are only similar.
    const double* n = other->GetTuple(id);
    EXPECT_GT(n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2], 0.95);
    EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0, 1e-6);
  }
  for (const auto& [id, normal] : ofCells)
  {
    EXPECT_NEAR(otherCells->GetComponent(id - 1000000, 1), normal[1], 1e-5);
  }
  this->Deformation->SetInteractivePoints(0);
  for (const int pieces : { 1, 7 })
  {
    EXPECT_EQ(this->normals(pieces, false), ofPoints);
    EXPECT_EQ(this->normals(pieces, true), ofCells);
  }
}

TEST_F(VtkMovedNormals, CanBeDropped)
{
  this->Deformation->SetNormals(vtkStreamingMeshDeformation::DROP);
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    EXPECT_TRUE(this->normals(2, false).empty());
    EXPECT_TRUE(this->normals(2, true).empty());
    EXPECT_FALSE(this->output()->GetPointData()->HasArray("Normals"));
    EXPECT_TRUE(this->output()->GetPointData()->HasArray("Colours"));
  }
}

TEST_F(VtkMovedNormals, OfTetrahedraAreDropped)
{
  this->open(tetBox(12, 7, 6, 0.1));
  this->Handles->Ends.left = 0.5;
  this->Handles->Ends.right = 10.5;
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    EXPECT_TRUE(this->normals(2, false).empty());
    EXPECT_TRUE(this->normals(2, true).empty());
  }
}

TEST_F(VtkMovedNormals, OfAnyTypeAndTangentsDoNotGetStale)
{
  this->Faulty->Spoil = [](vtkPointSet* mesh, int)
  {
    const vtkIdType count = mesh->GetNumberOfPoints();
    vtkNew<vtkSignedCharArray> active;
    vtkNew<vtkFloatArray> other;
    vtkNew<vtkFloatArray> tangents;
    const std::vector<std::pair<vtkDataArray*, const char*>> arrays{ { active, "Packed" },
      { other, "Normals" }, { tangents, "Along" } };
    for (const auto& [array, name] : arrays)
    {
      array->SetName(name);
      array->SetNumberOfComponents(3);
      array->SetNumberOfTuples(count);
      array->Fill(5.0);
    }
    mesh->GetPointData()->SetNormals(active);
    mesh->GetPointData()->AddArray(other);
    mesh->GetPointData()->SetTangents(tangents);
  };
  for (const vtkIdType interactive : { 200000, 0 })
  {
    this->Deformation->SetInteractivePoints(interactive);
    this->Deformation->SetNormals(vtkStreamingMeshDeformation::RECOMPUTE);
    const auto expected = this->normals(1, false);
    ASSERT_EQ(std::int64_t(expected.size()), this->Mesh.vertices());
    vtkPointData* points = this->output()->GetPointData();
    EXPECT_FALSE(points->HasArray("Along"));
    ASSERT_TRUE(points->HasArray("Packed") && points->HasArray("Normals"));
    for (const char* name : { "Packed", "Normals" })
    {
      const double* normal = points->GetArray(name)->GetTuple(7);
      EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0, 1e-6);
    }
    this->Deformation->SetNormals(vtkStreamingMeshDeformation::DROP);
    EXPECT_TRUE(this->normals(1, false).empty());
    EXPECT_FALSE(this->output()->GetPointData()->HasArray("Packed"));
    EXPECT_FALSE(this->output()->GetPointData()->HasArray("Normals"));
  }
}

TEST_F(VtkMovedPiece, HandleArraysAreKeptIfWanted)
{
  ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
  EXPECT_FALSE(this->output()->GetPointData()->HasArray(HandleMaskName));
  EXPECT_FALSE(this->output()->GetPointData()->HasArray(HandleRotationName));
  this->Deformation->KeepHandleArraysOn();
  ASSERT_TRUE(updatePiece(this->Deformation, 0, 1));
  EXPECT_TRUE(this->output()->GetPointData()->HasArray(HandleMaskName));
}

} // namespace
} // namespace smg::testing
