// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkMeshImport.h"

#include "Solver/Core/Error.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"

#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

using namespace smg;
using namespace smg::testing;

namespace
{

class VtkMeshImport : public ::testing::Test
{
protected:
  VtkMeshImport() { registerVtkImporter(); }

  std::string path(const char* name) const { return (this->Folder / name).string(); }

  template <class Writer, class Data>
  std::string write(const char* name, Data* data)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName(this->path(name).c_str());
    EXPECT_EQ(writer->Write(), 1);
    return this->path(name);
  }

  /** A line, a triangle and a tetrahedron on four points. */
  static vtkSmartPointer<vtkUnstructuredGrid> mixedGrid()
  {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const double corners[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (const auto& corner : corners)
    {
      points->InsertNextPoint(corner);
    }
    grid->SetPoints(points);
    const vtkIdType ids[] = { 0, 1, 2, 3 };
    grid->InsertNextCell(VTK_LINE, 2, ids);
    grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    return grid;
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(VtkMeshImport, PolyDataOfBothFormats)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* data = sphere->GetOutput();
  for (const std::string& file : { this->write<vtkPolyDataWriter>("a.vtk", data),
         this->write<vtkXMLPolyDataWriter>("a.vtp", data) })
  {
    const IndexedMesh mesh = importMesh(file);
    EXPECT_EQ(mesh.cellType, CellType::Triangle);
    EXPECT_EQ(mesh.vertices(), data->GetNumberOfPoints());
    EXPECT_EQ(mesh.cells(), data->GetNumberOfPolys());
    EXPECT_FALSE(mesh.doublePositions);
    ASSERT_EQ(mesh.vertexColumns.size(), 1u);
    EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float32, 3 }));
  }
}

TEST_F(VtkMeshImport, TetrahedraWinAndTheRestIsCounted)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = mixedGrid();
  for (const std::string& file : { this->write<vtkUnstructuredGridWriter>("a.vtk", grid.Get()),
         this->write<vtkXMLUnstructuredGridWriter>("a.vtu", grid.Get()) })
  {
    const IndexedMesh mesh = importMesh(file);
    EXPECT_EQ(mesh.cellType, CellType::Tetrahedron);
    EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3 }));
    EXPECT_EQ(mesh.originalCells, (std::vector<std::int64_t>{ 2 }));
    EXPECT_EQ(mesh.droppedCells, 2);
    EXPECT_TRUE(mesh.doublePositions);
  }
}

TEST_F(VtkMeshImport, StripsAndPolygonsBecomeTriangles)
{
  writeBytes(this->Folder / "a.vtk",
    "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n"
    "0 0 0 1 0 0 0 1 0 1 1 0 2 2 2\nPOLYGONS 1 5\n4 0 1 3 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n");
  const IndexedMesh mesh = importMesh(this->Folder / "a.vtk");
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 3, 0, 3, 2, 0, 1, 2, 2, 1, 3 }));
  EXPECT_EQ(mesh.triangulatedPolygons, 2);
}

TEST_F(VtkMeshImport, WhatCannotBeIsRefused)
{
  vtkSmartPointer<vtkUnstructuredGrid> grid = mixedGrid();
  const vtkIdType ids[] = { 0, 1, 2, 3, 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  EXPECT_THROW(importMesh(this->write<vtkXMLUnstructuredGridWriter>("a.vtu", grid.Get())), Error);
  grid = mixedGrid();
  const vtkIdType wrong[] = { 0, 1, 2, 4 };
  grid->InsertNextCell(VTK_TETRA, 4, wrong);
  EXPECT_THROW(importMesh(this->write<vtkXMLUnstructuredGridWriter>("b.vtu", grid.Get())), Error);
  grid = mixedGrid();
  grid->GetPoints()->SetPoint(1, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_THROW(importMesh(this->write<vtkXMLUnstructuredGridWriter>("c.vtu", grid.Get())), Error);
  writeBytes(this->Folder / "d.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET "
                                     "STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n");
  EXPECT_THROW(importMesh(this->Folder / "d.vtk"), Error);
  ImportOptions options;
  options.budget = MemoryBudget(1000);
  EXPECT_THROW(importMesh(this->Folder / "a.vtu", options), Error);
}

TEST_F(VtkMeshImport, TruncatedFilesAreRefused)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  for (const std::string& file : { this->write<vtkPolyDataWriter>("a.vtk", sphere->GetOutput()),
         this->write<vtkXMLPolyDataWriter>("a.vtp", sphere->GetOutput()) })
  {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    const std::string cut = this->path(file.ends_with("vtk") ? "cut.vtk" : "cut.vtp");
    for (std::size_t part = 0; part < 8; ++part)
    {
      writeBytes(cut, bytes.substr(0, bytes.size() * part / 10));
      EXPECT_THROW(importMesh(cut), Error) << cut << ' ' << part;
    }
  }
}
