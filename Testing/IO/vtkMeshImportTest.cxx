// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkMeshImport.h"

#include "IO/Container/NormalsColumn.h"
#include "IO/Import/VtkSizes.h"
#include "Solver/Core/Error.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
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

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <type_traits>
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
    if constexpr (std::is_base_of_v<vtkXMLWriter, Writer>)
    {
      writer->SetDataModeToBinary();
    }
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

TEST_F(VtkMeshImport, ActiveNormalsAreNormalsByWhateverName)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* data = sphere->GetOutput();
  data->GetPointData()->GetNormals()->SetName("Outwards");
  for (const bool taken : { false, true })
  {
    if (taken)
    {
      vtkNew<vtkFloatArray> other;
      other->SetName(NormalsName);
      other->SetNumberOfTuples(data->GetNumberOfPoints());
      other->Fill(0.0);
      data->GetPointData()->AddArray(other);
    }
    for (const std::string& file : { this->write<vtkPolyDataWriter>("a.vtk", data),
           this->write<vtkXMLPolyDataWriter>("a.vtp", data) })
    {
      const IndexedMesh mesh = importMesh(file);
      const ColumnSpec spec{ taken ? "Outwards" : NormalsName, ScalarType::Float32, 3 };
      EXPECT_GE(findColumn(mesh.vertexColumns, spec), 0) << file;
      EXPECT_EQ(mesh.vertexColumns.size(), taken ? 2u : 1u);
    }
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

TEST_F(VtkMeshImport, TruncatedGridsOfEveryDataModeAreRefused)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = mixedGrid();
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(this->path("a.vtu").c_str());
  for (const int mode : { vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended })
  {
    for (const bool encoded : { false, true })
    {
      writer->SetDataMode(mode);
      writer->SetEncodeAppendedData(encoded);
      ASSERT_EQ(writer->Write(), 1);
      std::ifstream stream(this->path("a.vtu"), std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(stream), {});
      for (std::size_t cut = 2; cut < bytes.size(); cut += 7)
      {
        writeBytes(this->Folder / "cut.vtu", bytes.substr(0, bytes.size() - cut));
        EXPECT_THROW(importMesh(this->path("cut.vtu")), Error) << mode << ' ' << cut;
      }
    }
  }
}

TEST_F(VtkMeshImport, EmptyCellsAreRefused)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = mixedGrid();
  grid->InsertNextCell(VTK_EMPTY_CELL, 0, static_cast<const vtkIdType*>(nullptr));
  EXPECT_THROW(importMesh(this->write<vtkXMLUnstructuredGridWriter>("a.vtu", grid.Get())), Error);
}

TEST_F(VtkMeshImport, ArraysCountForTheMemory)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(100);
  source->SetPhiResolution(100);
  source->Update();
  vtkPolyData* sphere = source->GetOutput();
  const std::int64_t points = sphere->GetNumberOfPoints();
  const auto sizes = [&] { return vtkSizes(this->path("a.vtp"), MeshFormat::VtkXml).mesh; };
  this->write<vtkXMLPolyDataWriter>("a.vtp", sphere);
  const std::int64_t before = sizes().vertexColumnBytes;
  vtkNew<vtkDoubleArray> array;
  array->SetName("nine");
  array->SetNumberOfComponents(9);
  array->SetNumberOfTuples(points);
  array->Fill(1.0);
  sphere->GetPointData()->AddArray(array);
  this->write<vtkXMLPolyDataWriter>("a.vtp", sphere);
  EXPECT_EQ(sizes().vertices, points);
  EXPECT_EQ(sizes().vertexColumnBytes, before + 2 * 72);
}

TEST_F(VtkMeshImport, AppendedDataAreReadOrRefusedWithAdvice)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(sphere->GetOutputPort());
  writer->SetFileName(this->path("a.vtp").c_str());
  writer->SetDataModeToAppended();
  ASSERT_EQ(writer->Write(), 1);
  try
  {
    const IndexedMesh mesh = importMesh(this->path("a.vtp"));
    EXPECT_EQ(mesh.cells(), sphere->GetOutput()->GetNumberOfPolys());
  }
  catch (const Error& error)
  {
    // VTK's parser and the version of Expat do not go together.
    EXPECT_NE(std::string(error.what()).find("binary or ascii"), std::string::npos) << error.what();
  }
}

TEST_F(VtkMeshImport, AdviceOnAppendedDataIsForFilesThatHaveThem)
{
  const std::string head = "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\" "
                           "NumberOfPolys=\"1\"><&></Piece></PolyData>";
  writeBytes(this->Folder / "a.vtp", head + "<AppendedData>_</AppendedData></VTKFile>");
  writeBytes(this->Folder / "b.vtp", head + "</VTKFile>");
  const std::string appended = messageOf([this] { importMesh(this->path("a.vtp")); });
  EXPECT_NE(appended.find("not well-formed"), std::string::npos) << appended;
  EXPECT_NE(appended.find("binary or ascii"), std::string::npos) << appended;
  EXPECT_EQ(std::count(appended.begin(), appended.end(), '\n'), 0) << appended;
  const std::string other = messageOf([this] { importMesh(this->path("b.vtp")); });
  EXPECT_NE(other.find("not well-formed"), std::string::npos) << other;
  EXPECT_EQ(other.find("binary or ascii"), std::string::npos) << other;
}
