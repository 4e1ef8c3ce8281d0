// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Mesh/Columns.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/VsmReader.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkElevationFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <vector>

namespace smg::testing
{
namespace
{

class VtkStreamingMeshWriterRestore : public ::testing::Test
{
protected:
  /** A reader of the stream of a mesh file, and a writer of its pieces in the file's order. */
  void start(const IndexedTestMesh& mesh, const std::string& name)
  {
    writeBytes(this->Folder / name, meshText(mesh));
    convert(this->Folder / name, this->Folder / "mesh.vsm");
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Reader->SetMaximumPointsInMemory(10);
    this->Writer->SetInputConnection(this->Reader->GetOutputPort());
    this->Writer->SetNumberOfStreamedPieces(5);
    this->Writer->RestoreOrderOn();
  }

  int write(const std::string& name)
  {
    this->Writer->SetFileName((this->Folder / name).c_str());
    return this->Writer->Write();
  }

  TemporaryFolder Folder;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingMeshWriter> Writer;
};

TEST_F(VtkStreamingMeshWriterRestore, GivesTheFileBack)
{
  const IndexedTestMesh surface = shuffled(torus(40, 30, 0.1));
  this->start(surface, "in.off");
  for (const char* name : { "out.ply", "out.off", "out.vtp", "out.obj", "out.vtk" })
  {
    ASSERT_TRUE(this->write(name)) << name;
    const ReadMesh back = importWhole(this->Folder / name);
    EXPECT_EQ(back.positions, surface.positions) << name;
    EXPECT_EQ(back.corners, surface.corners) << name;
  }
}

TEST_F(VtkStreamingMeshWriterRestore, GivesTetrahedraBack)
{
  const IndexedTestMesh volume = shuffled(tetBox(5, 6, 7, 0.1));
  this->start(volume, "in.mesh");
  for (const char* name : { "out.vtu", "out.mesh" })
  {
    ASSERT_TRUE(this->write(name)) << name;
    const ReadMesh back = importWhole(this->Folder / name);
    EXPECT_EQ(back.positions, volume.positions) << name;
    EXPECT_EQ(back.corners, volume.corners) << name;
  }
}

/** A grid with one isolated point first and two last. */
IndexedTestMesh gridWithIsolatedPoints()
{
  IndexedTestMesh mesh = grid(6, 6);
  mesh.positions.insert(mesh.positions.begin(), { 7, 8, 9 });
  mesh.positions.insert(mesh.positions.end(), { 1, 2, 3, 4, 5, 6 });
  for (std::int64_t& corner : mesh.corners)
  {
    ++corner;
  }
  return mesh;
}

TEST_F(VtkStreamingMeshWriterRestore, KeepsIsolatedPointsBehindAnyFilter)
{
  const IndexedTestMesh mesh = gridWithIsolatedPoints();
  this->start(mesh, "in.off");
  const vtkNew<vtkElevationFilter> filter;
  filter->SetInputConnection(this->Reader->GetOutputPort());
  this->Writer->SetInputConnection(filter->GetOutputPort());
  ASSERT_TRUE(this->write("out.ply"));
  EXPECT_EQ(importWhole(this->Folder / "out.ply").positions, mesh.positions);

  this->Writer->RestoreOrderOff();
  ASSERT_TRUE(this->write("saved.vsm"));
  const VsmReader saved(this->Folder / "saved.vsm");
  EXPECT_EQ(saved.isolatedVertices(), 3);
  EXPECT_GE(findColumn(saved.info().vertexColumns, { "Elevation", ScalarType::Float32, 1 }), 0);

  // Another file, without such points: those of the previous file are gone.
  convert(this->Folder / "in.off", this->Folder / "other.vsm");
  writeBytes(this->Folder / "whole.off", meshText(grid(4, 4)));
  convert(this->Folder / "whole.off", this->Folder / "other.vsm");
  this->Reader->SetFileName((this->Folder / "other.vsm").c_str());
  ASSERT_TRUE(this->write("saved.vsm"));
  EXPECT_EQ(VsmReader(this->Folder / "saved.vsm").isolatedVertices(), 0);
}

TEST_F(VtkStreamingMeshWriterRestore, SaysThatIsolatedPointsAreLeftOut)
{
  this->start(gridWithIsolatedPoints(), "in.off");
  this->Writer->RestoreOrderOff();
  for (const char* name : { "out.ply", "out.pvtp" })
  {
    const Errors warnings(this->Writer);
    ASSERT_TRUE(this->write(name)) << name;
    EXPECT_TRUE(warnings.contain("The 3 points of no cell are left out")) << warnings.text();
  }
}

/** Data made in memory does not name a file. */
TEST_F(VtkStreamingMeshWriterRestore, TakesIsolatedPointsFromTheStreamThatIsNamed)
{
  const IndexedTestMesh mesh = gridWithIsolatedPoints();
  this->start(mesh, "in.off");
  this->Reader->SetMaximumPointsInMemory(1000);
  this->Reader->Update();
  this->Writer->SetInputData(this->Reader->GetOutput());
  this->Writer->SetNumberOfStreamedPieces(1);
  const Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.ply"));
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.ply"));
  this->Writer->SetStreamFileName((this->Folder / "mesh.vsm").c_str());
  ASSERT_TRUE(this->write("out.ply"));
  EXPECT_EQ(importWhole(this->Folder / "out.ply").positions, mesh.positions);
  EXPECT_EQ(this->Folder.entries(), 3);
}

/** A mesh whose arrays hold the places that its points and cells have in another file. */
vtkSmartPointer<vtkUnstructuredGrid> meshFromElsewhere(const IndexedTestMesh& mesh)
{
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
  {
    points->InsertNextPoint(&mesh.positions[i]);
  }
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  const bool isSolid = mesh.cellType == CellType::Tetrahedron;
  const std::vector<vtkIdType> corners(mesh.corners.begin(), mesh.corners.end());
  const int count = cornersOf(mesh.cellType);
  for (std::size_t i = 0; i < corners.size(); i += static_cast<std::size_t>(count))
  {
    grid->InsertNextCell(isSolid ? VTK_TETRA : VTK_TRIANGLE, count, &corners[i]);
  }
  const auto placesOf = [](const char* name, vtkIdType tuples)
  {
    const auto places = vtkSmartPointer<vtkIdTypeArray>::New();
    places->SetName(name);
    for (vtkIdType i = 0; i < tuples; ++i)
    {
      places->InsertNextValue(2 * (tuples - i));
    }
    return places;
  };
  grid->GetPointData()->AddArray(placesOf(OriginalIdName, grid->GetNumberOfPoints()));
  grid->GetCellData()->AddArray(placesOf(OriginalCellIdName, grid->GetNumberOfCells()));
  return grid;
}

/** Where no array of the file could tell it, unasked. */
TEST_F(VtkStreamingMeshWriterRestore, KeepsTheOrderOfAMeshThatIsNoStream)
{
  const auto expectKept = [this](const IndexedTestMesh& mesh, const char* name, bool isAsked)
  {
    this->Writer->SetInputData(meshFromElsewhere(mesh));
    this->Writer->SetRestoreOrder(isAsked);
    ASSERT_TRUE(this->write(name)) << name;
    const ReadMesh back = importWhole(this->Folder / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.corners, mesh.corners) << name;
  };
  for (const IndexedTestMesh& mesh : { shuffled(torus(40, 30, 0.1)), gridWithIsolatedPoints() })
  {
    for (const char* name : { "out.ply", "out.vtp", "out.vtk", "out.off", "out.msh" })
    {
      expectKept(mesh, name, true);
    }
    for (const char* name : { "out.off", "out.obj", "out.mesh", "out.node" })
    {
      expectKept(mesh, name, false);
    }
  }
  const IndexedTestMesh solid = shuffled(tetBox(5, 6, 7, 0.1));
  for (const char* name : { "out.vtu", "out.msh" })
  {
    expectKept(solid, name, true);
  }
  for (const char* name : { "out.mesh", "out.node" })
  {
    expectKept(solid, name, false);
  }
}

TEST_F(VtkStreamingMeshWriterRestore, NamesAllFormatsForASolidThatIsNoStream)
{
  this->Writer->SetInputData(meshFromElsewhere(tetBox(3, 3, 3, 0.1)));
  const Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.off"));
  EXPECT_TRUE(errors.contain(".vsm")) << errors.text();
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST_F(VtkStreamingMeshWriterRestore, RefusesWhatHasNoOrderToRestore)
{
  this->start(grid(6, 6), "in.off");
  const Errors errors(this->Writer);
  EXPECT_FALSE(this->write("out.vsm"));
  EXPECT_FALSE(this->write("out.pvtp"));
  EXPECT_EQ(this->Folder.entries(), 2);
}

} // namespace
} // namespace smg::testing
