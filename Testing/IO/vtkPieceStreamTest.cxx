// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceStream.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkIdList.h"
#include "vtkPolyData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSphereSource.h"
#include "vtkTypeInt64Array.h"
#include "vtkTypeUInt64Array.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace smg::testing
{
namespace
{

/** A sink without work of its own, whose input is pulled. */
class VtkPieceStream : public ::testing::Test
{
protected:
  VtkPieceStream()
  {
    this->Mesh = writeVsm(this->Folder / "mesh.vsm", torus(60, 30, 0.2));
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->SetMaximumPointsInMemory(10);
    this->Filter->SetInputConnection(this->Reader->GetOutputPort());
    this->Sink->SetInputConnection(this->Filter->GetOutputPort());
  }

  /** Pulls everything; the sentence of the error, or none. */
  std::string pull(int pieces)
  {
    Errors silent(this->Filter);
    Errors silentReader(this->Reader);
    try
    {
      PieceInput input(*this->Sink, 0);
      PieceStream stream(
        input, { .given = pieces }, { .all = true, .required = {}, .optional = {} });
      Progress progress;
      this->Info = writeContainer(stream, this->Folder / "out.vsm", true, progress);
      return {};
    }
    catch (const Error& error)
    {
      return error.what();
    }
  }

  void expectSameMesh()
  {
    VsmReader reader(this->Folder / "out.vsm");
    const StreamMesh copy = collect(*reader.source());
    EXPECT_EQ(copy.positions, this->Mesh.positions);
    EXPECT_EQ(copy.corners, this->Mesh.corners);
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  StreamInfo Info;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkFaultyFilter> Filter;
  vtkNew<vtkFaultyFilter> Sink;
};

TEST_F(VtkPieceStream, AnyNumberOfPiecesGivesTheMesh)
{
  for (const int pieces : { 1, 2, 7, 64, 5000 })
  {
    EXPECT_EQ(this->pull(pieces), "");
    this->expectSameMesh();
    EXPECT_EQ(this->Info.vertexColumns.size(), 2U);
    EXPECT_EQ(this->Info.cellColumns.size(), 1U);
  }
}

TEST_F(VtkPieceStream, PullsEachPieceOnceAndInOrder)
{
  EXPECT_EQ(this->pull(5), "");
  EXPECT_EQ(
    this->Filter->Requests, (std::vector<std::string>{ "0/5", "1/5", "2/5", "3/5", "4/5" }));
}

TEST_F(VtkPieceStream, EndOfStreamingBringsThePreviewBack)
{
  EXPECT_EQ(this->pull(1), "");
  ASSERT_TRUE(updatePiece(this->Filter, 0, 1));
  EXPECT_TRUE(this->Filter->GetOutputDataObject(0)->GetFieldData()->GetArray("Preview"));
}

TEST_F(VtkPieceStream, FailureEndsStreamingToo)
{
  this->Filter->FailAtPiece = 0;
  EXPECT_NE(this->pull(1), "");
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  EXPECT_TRUE(this->Reader->GetOutputDataObject(0)->GetFieldData()->GetArray("Preview"));
}

TEST_F(VtkPieceStream, MeshWithoutFinalisationIsLegal)
{
  this->Filter->RemoveArray = "StreamFinalized";
  EXPECT_EQ(this->pull(7), "");
  this->expectSameMesh();
}

TEST_F(VtkPieceStream, MissingArraysAreNamed)
{
  this->Filter->RemoveArray = "GlobalIds";
  EXPECT_NE(this->pull(7).find("has no point GlobalIds"), std::string::npos);
  this->Filter->RemoveArray = "vtkGhostType";
  this->Filter->Modified();
  EXPECT_NE(this->pull(7).find("once more"), std::string::npos) << this->pull(7);
}

TEST_F(VtkPieceStream, FailureOfAPieceIsAnError)
{
  this->Filter->FailAtPiece = 3;
  EXPECT_NE(this->pull(7).find("Piece 3 of 7"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.vsm"));
  this->Filter->FailAtPiece = -1;
  this->Filter->Modified();
  EXPECT_EQ(this->pull(7), "");
}

TEST_F(VtkPieceStream, WhoHasChosenNoPiecesIsToldTheFilter)
{
  const auto expect = [this](const std::string& words)
  {
    this->Filter->Modified();
    const std::string error = this->pull(0);
    EXPECT_NE(error.find("The input from Faulty Filter " + words), std::string::npos) << error;
    EXPECT_EQ(error.find("Piece "), std::string::npos) << error;
  };
  this->Filter->FailAtPiece = 3;
  expect("could not be made");
  this->Filter->FailAtPiece = -1;
  for (const auto& [array, words] : std::map<std::string, std::string>{
         { "GlobalIds", "has no point GlobalIds" }, { "vtkGhostType", "owns the point" } })
  {
    this->Filter->RemoveArray = array;
    expect(words);
  }
  this->Filter->RemoveArray.clear();
  this->Filter->Spoil = [](vtkPointSet* mesh, int)
  { mesh->GetPoints()->SetPoint(0, HUGE_VAL, 0.0, 0.0); };
  expect("has a coordinate that is not a finite number");
}

/** Behind it there may be points of ghost cells alone. */
vtkIdType lastOwnPoint(vtkPointSet& piece)
{
  vtkUnsignedCharArray* ghosts = piece.GetPointGhostArray();
  vtkIdType last = piece.GetNumberOfPoints() - 1;
  while (last > 0 && ghosts->GetValue(last) != 0)
  {
    --last;
  }
  return last;
}

TEST_F(VtkPieceStream, SpoiledPiecesAreErrors)
{
  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 2)
    {
      vtkNew<vtkPoints> points;
      points->DeepCopy(mesh->GetPoints());
      points->SetPoint(lastOwnPoint(*mesh), 0.0, 0.0, std::nan(""));
      mesh->SetPoints(points);
    }
  };
  EXPECT_NE(this->pull(7).find("not a finite number"), std::string::npos);

  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 2)
    {
      vtkNew<vtkIdTypeArray> ids;
      ids->DeepCopy(mesh->GetPointData()->GetGlobalIds());
      ids->SetValue(lastOwnPoint(*mesh), VTK_ID_MAX / 2);
      mesh->GetPointData()->SetGlobalIds(ids);
    }
  };
  this->Filter->Modified();
  EXPECT_NE(this->pull(7).find("comes next"), std::string::npos);

  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 1)
    {
      vtkNew<vtkCellArray> quads;
      const vtkIdType corners[] = { 0, 1, 2, 3 };
      quads->InsertNextCell(4, corners);
      static_cast<vtkPolyData*>(mesh)->SetPolys(quads);
    }
  };
  this->Filter->Modified();
  EXPECT_NE(this->pull(7).find("neither all triangles"), std::string::npos);

  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 1)
    {
      vtkNew<vtkCellArray> cells;
      const vtkIdType corners[] = { 0, 1, VTK_ID_MAX - 5 };
      cells->InsertNextCell(3, corners);
      static_cast<vtkPolyData*>(mesh)->SetPolys(cells);
    }
  };
  this->Filter->Modified();
  EXPECT_NE(this->pull(7).find("does not exist"), std::string::npos);

  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 4)
    {
      mesh->GetPointData()->RemoveArray("Colours");
    }
  };
  this->Filter->Modified();
  EXPECT_NE(this->pull(7).find("no array Colours"), std::string::npos);
}

TEST_F(VtkPieceStream, TheSameDataForEveryPieceIsRefused)
{
  this->Filter->SetInputConnection(this->Reader->GetOutputPort());
  this->Reader->SetMaximumPointsInMemory(1000000);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  vtkNew<vtkPolyData> whole;
  whole->DeepCopy(this->Reader->GetOutputDataObject(0));
  this->Filter->SetInputDataObject(whole);
  EXPECT_NE(this->pull(7).find("same data for every piece"), std::string::npos);
  EXPECT_EQ(this->pull(1), "");
  this->expectSameMesh();
}

TEST_F(VtkPieceStream, MeshGivenDirectlyStaysWhole)
{
  this->Reader->SetMaximumPointsInMemory(1000000);
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  vtkNew<vtkPolyData> whole;
  whole->DeepCopy(this->Reader->GetOutputDataObject(0));
  this->Sink->SetInputDataObject(whole);
  EXPECT_NE(this->pull(4).find("same data for every piece"), std::string::npos);
  EXPECT_EQ(whole->GetNumberOfPoints(), this->Mesh.vertices());
  EXPECT_EQ(this->pull(1), "");
  EXPECT_EQ(whole->GetNumberOfPoints(), this->Mesh.vertices());
  EXPECT_EQ(whole->GetNumberOfCells(), this->Mesh.cells());
  EXPECT_EQ(whole->GetPointData()->GetNumberOfArrays(), 4);
  this->expectSameMesh();
}

TEST_F(VtkPieceStream, PointsNotInTheOrderOfFirstUseAreRefused)
{
  vtkNew<vtkSphereSource> source;
  source->Update();
  vtkNew<vtkPolyData> sphere;
  sphere->ShallowCopy(source->GetOutput());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalIds");
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    ids->InsertNextValue(i);
  }
  sphere->GetPointData()->SetGlobalIds(ids);
  this->Sink->SetInputDataObject(sphere);
  const std::string error = this->pull(1);
  EXPECT_NE(error.find("The input has a cell that uses the point with GlobalId"), std::string::npos)
    << error;
  EXPECT_NE(error.find("number the points in the order"), std::string::npos) << error;
}

TEST_F(VtkPieceStream, PointsWithoutCellsAreRefused)
{
  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece == 6)
    {
      auto* surface = static_cast<vtkPolyData*>(mesh);
      vtkNew<vtkCellArray> cells;
      const vtkIdType corners[] = { 0, 1, 2 };
      cells->InsertNextCell(3, corners);
      surface->SetPolys(cells);
      surface->GetCellData()->GetArray(0)->SetNumberOfTuples(1);
    }
  };
  EXPECT_NE(this->pull(7).find("belongs to no cell"), std::string::npos) << this->pull(7);
}

TEST_F(VtkPieceStream, FinalPointsThatAreUsedAgainAreRefused)
{
  this->Filter->Spoil = [](vtkPointSet* mesh, int piece)
  {
    if (piece < 3)
    {
      vtkNew<vtkUnsignedCharArray> all;
      all->SetName("StreamFinalized");
      all->SetNumberOfValues(mesh->GetNumberOfPoints());
      all->FillValue(1);
      mesh->GetPointData()->AddArray(all);
    }
  };
  EXPECT_NE(this->pull(7).find("StreamFinalized"), std::string::npos) << this->pull(7);
}

TEST_F(VtkPieceStream, PreviewsAreRefused)
{
  ASSERT_TRUE(updatePiece(this->Reader, 0, 1));
  vtkNew<vtkPolyData> preview;
  preview->DeepCopy(this->Reader->GetOutputDataObject(0));
  this->Filter->SetInputDataObject(preview);
  EXPECT_NE(this->pull(1).find("is a preview"), std::string::npos);
}

TEST_F(VtkPieceStream, OrdinarySourcesAreRefused)
{
  vtkNew<vtkSphereSource> source;
  this->Filter->SetInputConnection(source->GetOutputPort());
  EXPECT_NE(this->pull(4).find("GlobalIds"), std::string::npos);
}

/** Numbers beyond 2^53, of which double has only the even ones, in an array of the type. */
template <class Array>
vtkSmartPointer<vtkDataArray> numbersBeyondDouble(vtkIdType count)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName("GlobalIds");
  array->SetNumberOfComponents(1);
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetTypedComponent(i, 0, (std::int64_t(1) << 53) + 1 + i);
  }
  return array;
}

TEST(VtkGlobalIds, AreNeverDoubles)
{
  vtkNew<vtkPolyData> mesh;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[] = { 0, 1, 2 };
  for (int i = 0; i < 3; ++i)
  {
    points->InsertNextPoint(i, i * i, 0.0);
  }
  cells->InsertNextCell(3, corners);
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  const std::int64_t first = (std::int64_t(1) << 53) + 1;
  const vtkSmartPointer<vtkDataArray> arrays[] = { numbersBeyondDouble<vtkIdTypeArray>(3),
    numbersBeyondDouble<vtkTypeInt64Array>(3), numbersBeyondDouble<vtkTypeUInt64Array>(3),
    numbersBeyondDouble<vtkSOADataArrayTemplate<vtkTypeInt64>>(3) };
  for (const vtkSmartPointer<vtkDataArray>& ids : arrays)
  {
    mesh->GetPointData()->SetGlobalIds(ids);
    EXPECT_EQ(
      globalIdsOf(*mesh, "The input"), (std::vector<std::int64_t>{ first, first + 1, first + 2 }))
      << ids->GetClassName();
    EXPECT_FALSE(lacksStreamNumbering(*mesh)) << ids->GetClassName();
  }
  // Ids that are no integers at all are those of no point.
  vtkNew<vtkDoubleArray> real;
  for (const double id : { 0.0, 1e300, std::nan("") })
  {
    real->InsertNextValue(id);
  }
  mesh->GetPointData()->SetGlobalIds(real);
  constexpr std::int64_t None = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(globalIdsOf(*mesh, "The input"), (std::vector<std::int64_t>{ 0, None, None }));
  EXPECT_TRUE(lacksStreamNumbering(*mesh));
}

TEST_F(VtkPieceStream, ArraysOfFiltersBetweenBecomeColumns)
{
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(this->Reader->GetOutputPort());
  this->Filter->SetInputConnection(elevation->GetOutputPort());
  EXPECT_EQ(this->pull(7), "");
  this->expectSameMesh();
  EXPECT_EQ(this->Info.vertexColumns.back().name, "Elevation");
}

} // namespace
} // namespace smg::testing
