// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/PrecisionSource.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/WriteMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

using namespace smg;
using namespace smg::testing;

namespace
{

/** A column of T with arbitrary bits. */
template <class T>
Column column(const std::string& name, std::int64_t tuples, int components)
{
  std::vector<T> values(static_cast<std::size_t>(tuples * components));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<T>(static_cast<double>(i * 2654435761U % 4294967296U) / 34.0);
  }
  return makeColumn<T>(name, values, components);
}

/** Columns of every type, with numbers of components that give a part every size of remainder. */
std::vector<Column> everyColumn(std::int64_t tuples)
{
  return { column<std::int8_t>("int8", tuples, 1), column<std::uint8_t>("uint8 <&\">", tuples, 2),
    column<std::int16_t>("int16", tuples, 1), column<std::uint16_t>("uint16", tuples, 5),
    column<std::int32_t>("int32", tuples, 4), column<std::uint32_t>("uint32", tuples, 1),
    column<std::int64_t>("int64", tuples, 1), column<std::uint64_t>("uint64", tuples, 7),
    column<float>("float32", tuples, 3), column<double>("float64", tuples, 1) };
}

StreamMesh withColumns(const IndexedTestMesh& mesh)
{
  StreamMesh stream = toStream(mesh);
  for (double& coordinate : stream.positions)
  {
    coordinate = static_cast<double>(static_cast<float>(coordinate));
  }
  stream.vertexColumns = everyColumn(stream.vertices());
  stream.cellColumns = everyColumn(stream.cells());
  return stream;
}

void expectColumns(vtkFieldData* data, const std::vector<Column>& columns)
{
  ASSERT_EQ(data->GetNumberOfArrays(), static_cast<int>(columns.size()));
  for (const Column& column : columns)
  {
    vtkDataArray* array = data->GetArray(column.spec.name.c_str());
    ASSERT_TRUE(array) << column.spec.name;
    EXPECT_EQ(array->GetNumberOfComponents(), column.spec.components);
    ASSERT_EQ(array->GetNumberOfTuples(), static_cast<vtkIdType>(column.tuples()));
    ASSERT_EQ(static_cast<std::size_t>(array->GetDataTypeSize()), sizeOf(column.spec.type));
    EXPECT_EQ(array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE,
      column.spec.type >= ScalarType::Float32);
    EXPECT_EQ(std::memcmp(array->GetVoidPointer(0), column.bytes.data(), column.bytes.size()), 0)
      << column.spec.name;
  }
}

/** Reads the file with VTK and expects the mesh, bit for bit. */
template <class Reader>
void expectFile(const std::filesystem::path& path, const StreamMesh& mesh, bool doublePositions)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPointSet* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), mesh.vertices()) << path;
  ASSERT_EQ(data->GetNumberOfCells(), mesh.cells()) << path;
  EXPECT_EQ(data->GetPoints()->GetDataType(), doublePositions ? VTK_DOUBLE : VTK_FLOAT);
  for (vtkIdType i = 0; i < mesh.vertices(); ++i)
  {
    double point[3];
    data->GetPoint(i, point);
    ASSERT_EQ(std::memcmp(point, mesh.positions.data() + 3 * i, sizeof(point)), 0) << i;
  }
  const vtkIdType corners = cornersOf(mesh.cellType);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < mesh.cells(); ++c)
  {
    ASSERT_EQ(data->GetCellType(c), corners == 3 ? VTK_TRIANGLE : VTK_TETRA);
    data->GetCellPoints(c, ids);
    ASSERT_EQ(ids->GetNumberOfIds(), corners);
    for (vtkIdType k = 0; k < corners; ++k)
    {
      ASSERT_EQ(ids->GetId(k), mesh.corners[static_cast<std::size_t>(c * corners + k)]) << c;
    }
  }
  expectColumns(data->GetPointData(), mesh.vertexColumns);
  expectColumns(data->GetCellData(), mesh.cellColumns);
}

} // namespace

TEST(WriteVtkXml, VtkReadsTheSameBits)
{
  TemporaryFolder folder;
  for (const IndexedTestMesh& mesh : { torus(11, 7, 0.1), sphere(0), tetBox(5, 4, 3, 0.1) })
  {
    const StreamMesh stream = withColumns(mesh);
    for (const std::int64_t blockCells : { 1, 2, 5, 1000 })
    {
      for (const bool doublePositions : { false, true })
      {
        PrecisionSource grid(stream, blockCells, doublePositions);
        writeMesh(grid, folder / "a.vtu");
        expectFile<vtkXMLUnstructuredGridReader>(folder / "a.vtu", stream, doublePositions);
        if (stream.cellType == CellType::Triangle)
        {
          PrecisionSource surface(stream, blockCells, doublePositions);
          writeMesh(surface, folder / "a.vtp");
          expectFile<vtkXMLPolyDataReader>(folder / "a.vtp", stream, doublePositions);
        }
      }
    }
  }
}

/** As in the reader of streams. */
TEST(WriteVtkXml, NormalsAndTextureCoordinatesAreActive)
{
  TemporaryFolder folder;
  StreamMesh mesh = toStream(torus(9, 6));
  for (const ColumnSpec& spec : { ColumnSpec{ NormalsName, ScalarType::Float32, 3 },
         ColumnSpec{ TextureCoordinatesName, ScalarType::Float64, 2 } })
  {
    mesh.vertexColumns.push_back({ spec, {} });
    mesh.vertexColumns.back().resize(static_cast<std::size_t>(mesh.vertices()));
  }
  PrecisionSource surface(mesh, 5, true);
  writeMesh(surface, folder / "a.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "a.vtp").c_str());
  reader->Update();
  vtkPointData* points = reader->GetOutput()->GetPointData();
  EXPECT_TRUE(points->GetNormals());
  EXPECT_TRUE(points->GetTCoords());
}

TEST(WriteVtkXml, VtkReadsArraysOfMegabytes)
{
  TemporaryFolder folder;
  const StreamMesh stream = withColumns(torus(300, 200));
  PrecisionSource source(stream, 1000, true);
  writeMesh(source, folder / "a.vtp");
  expectFile<vtkXMLPolyDataReader>(folder / "a.vtp", stream, true);
}
