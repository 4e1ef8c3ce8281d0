// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/OrdinaryMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

// A mesh that VTK has in memory becomes the same file, byte for byte, as the .vtu or .vtp file that
// VTK itself writes of it.

namespace smg::testing
{
namespace
{

using VtkMesh = vtkSmartPointer<vtkPointSet>;
using CellPoints = std::vector<std::vector<vtkIdType>>;

vtkSmartPointer<vtkPoints> pointsOfType(int type, vtkIdType count)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->InsertNextPoint(i % 4, (i / 4) % 4, double(i / 16) + (type == VTK_INT ? 0 : 0.1));
  }
  return points;
}

vtkSmartPointer<vtkCellArray> cellsOfPoints(const CellPoints& cells, bool is64Bit)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  is64Bit ? array->Use64BitStorage() : array->Use32BitStorage();
  for (const std::vector<vtkIdType>& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

/** All four lists of a surface. */
VtkMesh surfaceOfLists(int pointType = VTK_FLOAT, bool is64Bit = true)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(pointsOfType(pointType, 32));
  mesh->SetVerts(cellsOfPoints({ { 0 }, { 1, 2 } }, is64Bit));
  mesh->SetLines(cellsOfPoints({ { 0, 1, 2 } }, is64Bit));
  CellPoints polygons{ { 0, 1, 4 }, { 1, 2, 6, 5 }, { 8, 9, 10, 14, 12 }, { 16, 17, 20 } };
  CellPoints strips{ { 20, 21, 24, 25, 28, 29 } };
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0) // the writer of VTK 9.1 crashes
  polygons.insert(polygons.begin() + 3, { 3, 7 });
  strips.push_back({ 17, 18 });
#endif
  mesh->SetPolys(cellsOfPoints(polygons, is64Bit));
  mesh->SetStrips(cellsOfPoints(strips, is64Bit));
  return mesh;
}

VtkMesh gridOfCells(const std::vector<std::pair<int, std::vector<vtkIdType>>>& cells)
{
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->SetPoints(pointsOfType(VTK_DOUBLE, 48));
  for (const auto& [type, points] : cells)
  {
    mesh->InsertNextCell(type, static_cast<vtkIdType>(points.size()), points.data());
  }
  return mesh;
}

VtkMesh mixedSolids()
{
  return gridOfCells({ { VTK_VERTEX, { 0 } }, { VTK_TETRA, { 0, 1, 4, 16 } },
    { VTK_HEXAHEDRON, { 1, 2, 6, 5, 17, 18, 22, 21 } }, { VTK_QUAD, { 1, 2, 6, 5 } },
    { VTK_VOXEL, { 2, 3, 6, 7, 18, 19, 22, 23 } }, { VTK_WEDGE, { 8, 9, 12, 24, 25, 28 } },
    { VTK_PYRAMID, { 9, 10, 14, 13, 26 } } });
}

VtkMesh quadraticSolids()
{
  return gridOfCells({ { VTK_QUADRATIC_TETRA, { 0, 1, 4, 16, 2, 3, 5, 6, 7, 8 } },
    { VTK_TETRA, { 0, 4, 1, 32 } }, { VTK_QUADRATIC_TRIANGLE, { 0, 1, 4, 9, 10, 11 } } });
}

VtkMesh gridOfSurfaces()
{
  return gridOfCells({ { VTK_TRIANGLE, { 0, 1, 4 } }, { VTK_PIXEL, { 1, 2, 5, 6 } },
    { VTK_POLYGON, { 8, 9, 10, 14, 12 } }, { VTK_TRIANGLE_STRIP, { 20, 21, 24, 25, 28 } },
    { VTK_POLY_LINE, { 0, 1, 2 } }, { VTK_QUADRATIC_QUAD, { 32, 33, 37, 36, 40, 41, 42, 43 } } });
}

template <class Array>
vtkSmartPointer<Array> sevenths(const char* name, vtkIdType tuples, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int k = 0; k < components; ++k)
    {
      array->SetComponent(i, k, double((7 * i + k) % 100));
    }
  }
  return array;
}

/** Arrays of every type of numbers, of contiguous tuples or not. */
void addAllTypes(vtkDataSetAttributes& to, vtkIdType tuples)
{
  to.AddArray(sevenths<vtkCharArray>("char", tuples));
  to.AddArray(sevenths<vtkSignedCharArray>("signed char", tuples, 2));
  to.AddArray(sevenths<vtkUnsignedCharArray>("unsigned char", tuples, 4));
  to.AddArray(sevenths<vtkShortArray>("short", tuples));
  to.AddArray(sevenths<vtkUnsignedShortArray>("unsigned short", tuples));
  to.AddArray(sevenths<vtkIntArray>("int", tuples, 9));
  to.AddArray(sevenths<vtkUnsignedIntArray>("unsigned int", tuples));
  to.AddArray(sevenths<vtkLongLongArray>("long long", tuples));
  to.AddArray(sevenths<vtkUnsignedLongLongArray>("unsigned long long", tuples));
  to.AddArray(sevenths<vtkIdTypeArray>("id", tuples));
  to.AddArray(sevenths<vtkFloatArray>("float", tuples, 3));
  to.AddArray(sevenths<vtkDoubleArray>("double", tuples));
  to.AddArray(sevenths<vtkSOADataArrayTemplate<float>>("not contiguous", tuples, 3));
}

void addToBoth(VtkMesh& mesh, const std::function<void(vtkDataSetAttributes&, vtkIdType)>& add)
{
  add(*mesh->GetPointData(), mesh->GetNumberOfPoints());
  add(*mesh->GetCellData(), mesh->GetNumberOfCells());
}

/** Arrays whose names or kinds mean something. */
void addSpecialArrays(vtkDataSetAttributes& to, vtkIdType tuples)
{
  to.SetNormals(sevenths<vtkFloatArray>("Directions", tuples, 3));
  const auto unnamed = sevenths<vtkDoubleArray>("", tuples);
  unnamed->SetName(nullptr);
  to.SetScalars(unnamed);
  const auto twice = sevenths<vtkDoubleArray>("other", tuples);
  to.AddArray(sevenths<vtkFloatArray>("twice", tuples));
  to.AddArray(twice);
  twice->SetName("twice");
  to.AddArray(sevenths<vtkIntArray>("OriginalId", tuples));
  to.AddArray(sevenths<vtkIdTypeArray>("OriginalCellId", tuples));
  to.AddArray(sevenths<vtkUnsignedCharArray>("CellFlags", tuples));
  to.AddArray(sevenths<vtkIntArray>("too short", tuples - 1));
  vtkNew<vtkStringArray> texts;
  texts->SetName("texts");
  texts->SetNumberOfValues(tuples);
  to.AddArray(texts);
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  bits->SetNumberOfValues(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    bits->SetValue(i, i % 2);
  }
  to.AddArray(bits);
}

std::map<std::string, VtkMesh> meshesOfVtk()
{
  std::map<std::string, VtkMesh> all{ { "surface", surfaceOfLists() }, { "solids", mixedSolids() },
    { "quadratic", quadraticSolids() }, { "surface grid", gridOfSurfaces() },
    { "32 bits", surfaceOfLists(VTK_DOUBLE, false) },
    { "integer points", surfaceOfLists(VTK_INT) } };
  const std::map<std::string, std::function<VtkMesh()>> kinds{
    { "surface", [] { return surfaceOfLists(); } }, { "solids", mixedSolids }
  };
  for (const auto& [name, make] : kinds)
  {
    const std::string of = std::string(" of ") + name;
    addToBoth(all["types" + of] = make(), addAllTypes);
    addToBoth(all["special arrays" + of] = make(), addSpecialArrays);
    VtkMesh& ghosts = all["ghosts" + of] = make();
    addToBoth(ghosts, addAllTypes);
    addToBoth(ghosts,
      [](vtkDataSetAttributes& to, vtkIdType tuples)
      {
        const auto marks = sevenths<vtkUnsignedCharArray>("vtkGhostType", tuples);
        marks->Fill(0);
        marks->SetValue(2, 1);
        marks->SetValue(4, 32);
        marks->SetValue(5, 2);
        to.AddArray(marks);
      });
  }
  return all;
}

std::string bytesOfFile(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/** The mesh without arrays that no file of VTK should have: of another length. */
VtkMesh withoutOthers(vtkPointSet& mesh)
{
  const auto copy = VtkMesh::Take(mesh.NewInstance());
  copy->ShallowCopy(&mesh);
  copy->GetPointData()->RemoveArray("too short");
  copy->GetCellData()->RemoveArray("too short");
  return copy;
}

/** What a conversion of VTK's own file makes. */
ConversionReport convertFileOf(
  vtkPointSet& mesh, const std::filesystem::path& folder, const std::filesystem::path& out)
{
  const bool isSurface = mesh.IsA("vtkPolyData") != 0;
  const std::filesystem::path file = folder / (isSurface ? "mesh.vtp" : "mesh.vtu");
  const VtkMesh plain = withoutOthers(mesh);
  const auto write = [&](vtkXMLWriter& writer)
  {
    writer.SetFileName(file.c_str());
    writer.SetInputDataObject(plain);
    EXPECT_EQ(writer.Write(), 1);
  };
  isSurface ? write(*vtkNew<vtkXMLPolyDataWriter>())
            : write(*vtkNew<vtkXMLUnstructuredGridWriter>());
  ConversionOptions options;
  options.cells = countingCells(mesh);
  return convert(file, out, options);
}

} // namespace

TEST(VtkMeshArrays, BecomeWhatTheFileOfVtkBecomes)
{
  const TemporaryFolder folder;
  for (const auto& [name, mesh] : meshesOfVtk())
  {
    SCOPED_TRACE(name);
    const auto ofFile = folder.path() / "file.vsm", ofMemory = folder.path() / "memory.vsm";
    const ConversionReport expected = convertFileOf(*mesh, folder.path(), ofFile);
    const ConversionReport found = writeOrdinaryMesh(*mesh, ofMemory, {});
    EXPECT_EQ(bytesOfFile(ofMemory), bytesOfFile(ofFile));
    EXPECT_GT(found.cells, 0);
    EXPECT_EQ(found.dropped_cells, expected.dropped_cells);
    EXPECT_EQ(found.triangulated_polygons, expected.triangulated_polygons);
    EXPECT_EQ(found.split_cells, expected.split_cells);
    EXPECT_EQ(found.higher_order_cells, expected.higher_order_cells);
    EXPECT_EQ(found.keeps_numbers, expected.keeps_numbers);
    const std::size_t notes = expected.notes.size();
    ASSERT_EQ(found.notes.size(), notes + (found.dropped_cells > 0 ? 1 : 0));
    EXPECT_EQ(std::vector(found.notes.begin(), found.notes.begin() + std::ptrdiff_t(notes)),
      expected.notes);
  }
}

TEST(VtkMeshArrays, TakeNoFileOfVtkOnTheirWay)
{
  const TemporaryFolder folder;
  for (const VtkMesh& mesh : { surfaceOfLists(), mixedSolids() })
  {
    ConversionOptions options;
    options.scratch = folder.path();
    std::vector<std::string> seen;
    options.progress = [&](double)
    {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
      {
        seen.push_back(entry.path().filename().string());
      }
      return true;
    };
    writeOrdinaryMesh(*mesh, folder.path() / "out.vsm", options);
    ASSERT_FALSE(seen.empty());
    for (const std::string& name : seen)
    {
      EXPECT_FALSE(name.ends_with(".vtu") || name.ends_with(".vtp")) << name;
    }
  }
}

/** VTK writes these names as they are, and no XML. */
TEST(VtkMeshArrays, HaveNamesOfAnyCharacters)
{
  const char* const name = "a <\"name\"> & more";
  const VtkMesh mesh = mixedSolids();
  mesh->GetPointData()->AddArray(sevenths<vtkIntArray>(name, mesh->GetNumberOfPoints()));
  const TemporaryFolder folder;
  writeOrdinaryMesh(*mesh, folder.path() / "out.vsm", {});
  const std::vector<ColumnSpec> columns = VsmReader(folder.path() / "out.vsm").info().vertexColumns;
  EXPECT_TRUE(
    std::ranges::any_of(columns, [name](const ColumnSpec& column) { return column.name == name; }));
}

TEST(VtkMeshArrays, NameTheirPointsAndCellsInErrors)
{
  const auto bad =
    [](const std::function<void(vtkPointSet&)>& spoil, VtkMesh mesh = surfaceOfLists())
  {
    spoil(*mesh);
    return mesh;
  };
  const auto withOffset = [](vtkPointSet& mesh)
  {
    auto* polys = vtkPolyData::SafeDownCast(&mesh)->GetPolys();
    polys->GetOffsetsArray()->SetComponent(2, 0, 1.0);
  };
  const auto withCorner = [](double corner)
  {
    return [corner](vtkPointSet& mesh)
    {
      vtkPolyData::SafeDownCast(&mesh)->GetPolys()->GetConnectivityArray()->SetComponent(
        4, 0, corner);
    };
  };
  const auto onlyLines = [](vtkPointSet& mesh)
  {
    vtkPolyData::SafeDownCast(&mesh)->SetPolys(nullptr);
    vtkPolyData::SafeDownCast(&mesh)->SetStrips(nullptr);
  };
  const auto corners = std::to_string(
    vtkPolyData::SafeDownCast(surfaceOfLists())->GetPolys()->GetNumberOfConnectivityIds());
  const std::pair<VtkMesh, std::string> cases[] = {
    { bad([](vtkPointSet& mesh) { mesh.GetPoints()->SetPoint(5, 0.0, std::nan(""), 0.0); }),
      "The input, point 5: a coordinate is not finite." },
    { bad(withCorner(77.0)),
      "The input, cell 4: the corner 77 is not a vertex: they are 0 to 31." },
    { bad(withCorner(-1.0)),
      "The input, cell 4: the corner -1 is not a vertex: they are 0 to 31." },
    { bad(withOffset), "The input, cell 4: its points should be the numbers from 3 up to 1 of " +
                         corners + ", which cannot be." },
    { bad(onlyLines),
      "The input has only points and lines, as a slice or a contour of a surface has: a mesh of "
      "triangles, other polygons or solid cells is needed." },
    { gridOfCells(
        { { VTK_TETRA, { 0, 1, 4, 16 } }, { VTK_CONVEX_POINT_SET, { 0, 1, 4, 16, 17 } } }),
      "The input, cell 1: its type is convex point set, which is not read: cut the mesh into "
      "triangles or tetrahedra first." },
    { gridOfCells({ { VTK_LINE, { 0, 1 } }, { VTK_CONVEX_POINT_SET, { 0, 1, 4, 16, 17 } } }),
      "The input has cells of the type convex point set, which are not cut into tetrahedra here: "
      "put Tetrahedralize before." },
    { gridOfCells({ { VTK_PENTAGONAL_PRISM, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 } } }),
      "The input has cells of the type pentagonal prism, which are not cut into tetrahedra here: "
      "put Tetrahedralize before." },
    { gridOfCells({ { VTK_HEXAGONAL_PRISM, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 } } }),
      "The input has cells of the type hexagonal prism, which are not cut into tetrahedra here: "
      "put Tetrahedralize before." },
    { gridOfCells({ { VTK_TETRA, { 0, 1, 4, 16 } }, { VTK_HEXAHEDRON, { 0, 1, 4, 16, 17 } } }),
      "The input, cell 1: it has 5 points, which its type, VTK's 12, cannot have." },
  };
  const TemporaryFolder folder;
  for (const auto& [mesh, sentence] : cases)
  {
    try
    {
      writeOrdinaryMesh(*mesh, folder.path() / "out.vsm", {});
      ADD_FAILURE() << "no error: " << sentence;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.what(), sentence);
    }
  }
}

} // namespace smg::testing
