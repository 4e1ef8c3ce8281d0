// SPDX-License-Identifier: BSD-3-Clause

#include "IO/Mesh/Columns.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Error.h"

#include <vtkCellType.h>
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

#include <string>
#include <vector>

using namespace smg;
using namespace smg::testing;

namespace
{

/** Files written by VTK yield the mesh of VTK. */
class VtkWrittenFiles : public ::testing::Test
{
protected:
  std::string path(const std::string& name) const { return (this->Folder / name).string(); }

  ReadMesh read(const std::string& name, std::int64_t memory = std::int64_t(64) << 20)
  {
    Workspace workspace(this->Folder.path(), memory);
    return readRaw(importMesh(this->path(name), workspace));
  }

  template <class Writer>
  void writeLegacy(const std::string& name, vtkDataSet* data, int type, int version)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName(this->path(name).c_str());
    writer->SetFileType(type);
    writer->SetFileVersion(version);
    ASSERT_EQ(writer->Write(), 1);
  }

  template <class Writer>
  void writeXml(const std::string& name, vtkDataSet* data, int mode, int compressor, bool encode)
  {
    vtkNew<Writer> writer;
    writer->SetInputDataObject(data);
    writer->SetFileName(this->path(name).c_str());
    writer->SetDataMode(mode);
    writer->SetCompressorType(compressor);
    writer->SetEncodeAppendedData(encode);
    ASSERT_EQ(writer->Write(), 1);
  }

  /** Tetrahedra, a wedge and a line on nine points. */
  static vtkSmartPointer<vtkUnstructuredGrid> grid()
  {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int i = 0; i < 9; ++i)
    {
      points->InsertNextPoint(i / 3.0, i % 3, i % 2);
    }
    grid->SetPoints(points);
    const vtkIdType ids[] = { 3, 1, 4, 0, 5, 8, 2, 6 };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    grid->InsertNextCell(VTK_LINE, 2, ids);
    grid->InsertNextCell(VTK_WEDGE, 6, ids);
    grid->InsertNextCell(VTK_TETRA, 4, ids + 3);
    return grid;
  }

  TemporaryFolder Folder;
};

void expectSame(const ReadMesh& mesh, const ReadMesh& expected, const std::string& what)
{
  EXPECT_EQ(mesh.cellType, expected.cellType) << what;
  EXPECT_EQ(mesh.positions, expected.positions) << what;
  EXPECT_EQ(mesh.corners, expected.corners) << what;
  EXPECT_EQ(mesh.elements, expected.elements) << what;
  ASSERT_EQ(mesh.vertexColumns.size(), expected.vertexColumns.size()) << what;
  for (std::size_t i = 0; i < mesh.vertexColumns.size(); ++i)
  {
    EXPECT_EQ(mesh.vertexColumns[i].spec, expected.vertexColumns[i].spec) << what;
    EXPECT_EQ(mesh.vertexColumns[i].bytes, expected.vertexColumns[i].bytes) << what;
  }
}

} // namespace

TEST_F(VtkWrittenFiles, PolyDataOfEveryFormat)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(50);
  sphere->SetPhiResolution(50);
  sphere->Update();
  vtkPolyData* data = sphere->GetOutput();
  this->writeLegacy<vtkPolyDataWriter>("a.vtk", data, VTK_BINARY, 42);
  const ReadMesh expected = this->read("a.vtk");
  ASSERT_EQ(expected.vertices(), data->GetNumberOfPoints());
  ASSERT_EQ(expected.cells(), data->GetNumberOfPolys());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(expected.positions[static_cast<std::size_t>(3 * i + 1)], data->GetPoint(i)[1]);
  }
  ASSERT_EQ(expected.vertexColumns.size(), 1u);
  EXPECT_EQ(expected.vertexColumns[0].spec, (ColumnSpec{ "Normals", ScalarType::Float32, 3 }));
  this->writeLegacy<vtkPolyDataWriter>("b.vtk", data, VTK_BINARY, 51);
  expectSame(this->read("b.vtk"), expected, "5.1");
  for (const int mode : { vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended })
  {
    for (const int compressor :
      { vtkXMLWriter::NONE, vtkXMLWriter::LZ4, vtkXMLWriter::ZLIB, vtkXMLWriter::LZMA })
    {
      this->writeXml<vtkXMLPolyDataWriter>("a.vtp", data, mode, compressor, true);
      expectSame(
        this->read("a.vtp"), expected, std::to_string(mode) + ' ' + std::to_string(compressor));
    }
  }
}

TEST_F(VtkWrittenFiles, GridsOfEveryFormat)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = this->grid();
  this->writeLegacy<vtkUnstructuredGridWriter>("a.vtk", grid, VTK_ASCII, 51);
  const ReadMesh expected = this->read("a.vtk");
  EXPECT_EQ(expected.elements, (std::vector<std::int64_t>{ 0, 2, 2, 2, 3 }));
  EXPECT_EQ(expected.counts.droppedCells, 1);
  for (const int compressor : { vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZMA })
  {
    const int mode = vtkXMLWriter::Binary;
    this->writeXml<vtkXMLUnstructuredGridWriter>("a.vtu", grid, mode, compressor, false);
    const ReadMesh mesh = this->read("a.vtu");
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_EQ(mesh.elements, expected.elements);
    EXPECT_EQ(mesh.positions[3], grid->GetPoint(1)[0]);
  }
}

TEST_F(VtkWrittenFiles, ActiveNormalsAreNormalsByWhateverName)
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
    this->writeLegacy<vtkPolyDataWriter>("a.vtk", data, VTK_BINARY, 42);
    this->writeXml<vtkXMLPolyDataWriter>(
      "a.vtp", data, vtkXMLWriter::Binary, vtkXMLWriter::LZMA, true);
    for (const char* file : { "a.vtk", "a.vtp" })
    {
      const ReadMesh mesh = this->read(file);
      const ColumnSpec spec{ taken ? "Outwards" : NormalsName, ScalarType::Float32, 3 };
      EXPECT_GE(findColumn(mesh.vertexColumns, spec), 0) << file;
      EXPECT_EQ(mesh.vertexColumns.size(), taken ? 2u : 1u);
    }
  }
}

TEST_F(VtkWrittenFiles, DamageOfCompressedDataIsFound)
{
  const vtkSmartPointer<vtkUnstructuredGrid> grid = this->grid();
  this->writeXml<vtkXMLUnstructuredGridWriter>(
    "a.vtu", grid, vtkXMLWriter::Appended, vtkXMLWriter::LZMA, true);
  EXPECT_EQ(this->read("a.vtu").vertices(), 9);
  std::ifstream stream(this->path("a.vtu"), std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::size_t data = bytes.find('_', bytes.find("<AppendedData")) + 60;
  bytes.replace(data, 8, "AAAAAAAA");
  writeBytes(this->path("b.vtu"), bytes);
  expectError([this] { this->read("b.vtu"); }, this->path("b.vtu"));
}

TEST_F(VtkWrittenFiles, CompressedFilesNeedNoMemoryOfTheirSize)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(400);
  sphere->SetPhiResolution(400);
  sphere->Update();
  for (const int compressor : { vtkXMLWriter::LZMA, vtkXMLWriter::ZLIB })
  {
    this->writeXml<vtkXMLPolyDataWriter>(
      "a.vtp", sphere->GetOutput(), vtkXMLWriter::Binary, compressor, true);
    EXPECT_EQ(this->read("a.vtp", Workspace::MinMemory).vertices(),
      sphere->GetOutput()->GetNumberOfPoints());
  }
}
