// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "Testing/Filters/LinearSolution.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkAppendPolyData.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

// Meshes of other sources than readers of streams, as they are: any cells, points of no cell, no
// GlobalIds. A linear function is the solution of the finite elements on each of them.

namespace smg::testing
{
namespace
{

/** The hexahedra of a box with the corners moved by a linear map, and a point of no cell. */
vtkNew<vtkUnstructuredGrid> hexahedra(int n)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int z = 0; z <= n; ++z)
  {
    for (int y = 0; y <= n; ++y)
    {
      for (int x = 0; x <= n; ++x)
      {
        points->InsertNextPoint(x + 0.3 * y, y + 0.1 * z, z);
      }
    }
  }
  vtkNew<vtkUnstructuredGrid> grid;
  const auto id = [n](int x, int y, int z) { return vtkIdType((z * (n + 1) + y) * (n + 1) + x); };
  for (int z = 0; z < n; ++z)
  {
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        const vtkIdType corners[8] = { id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z),
          id(x, y + 1, z), id(x, y, z + 1), id(x + 1, y, z + 1), id(x + 1, y + 1, z + 1),
          id(x, y + 1, z + 1) };
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      }
    }
  }
  points->InsertNextPoint(0.4 * n, 0.5 * n, 0.5 * n);
  grid->SetPoints(points);
  return grid;
}

class VtkOrdinaryMesh : public ::testing::Test
{
protected:
  vtkPointSet* solve(vtkPointSet* mesh) { return solveLinear(*this->Poisson, mesh); }

  /** The output is the input with its arrays, and X is its solution at all points with cells. */
  void expectLinear(vtkPointSet* mesh, vtkIdType withoutCells)
  {
    Errors errors(this->Poisson);
    vtkPointSet* output = this->solve(mesh);
    ASSERT_TRUE(errors.text().empty()) << errors.text();
    EXPECT_EQ(this->Poisson->GetConverged(), 1);
    EXPECT_EQ(output->GetNumberOfPoints(), mesh->GetNumberOfPoints());
    EXPECT_EQ(output->GetNumberOfCells(), mesh->GetNumberOfCells());
    EXPECT_FALSE(output->GetPointData()->GetGlobalIds());
    EXPECT_FALSE(output->GetPointData()->HasArray("OriginalId"));
    vtkDataArray* solution = output->GetPointData()->GetArray("Solution");
    vtkDataArray* linear = output->GetPointData()->GetArray("X");
    ASSERT_TRUE(solution && linear);
    vtkIdType missing = 0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      if (std::isnan(solution->GetTuple1(i)))
      {
        ++missing;
      }
      else
      {
        ASSERT_NEAR(solution->GetTuple1(i), linear->GetTuple1(i), 1e-6) << i;
      }
    }
    EXPECT_EQ(missing, withoutCells);
  }

  /** The arrays Gradient and Flux of the last output are those of X with this gradient; `without`
   * cells have none. */
  void expectGradient(double x, double y, double z, vtkIdType without)
  {
    vtkCellData& cells =
      *vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0))->GetCellData();
    const double expected[] = { x, y, z };
    for (const auto& [name, factor] :
      { std::pair("Gradient", 1.0), std::pair("Flux", -this->Poisson->GetConductivity()) })
    {
      vtkDataArray* found = cells.GetArray(name);
      ASSERT_TRUE(found) << name;
      vtkIdType missing = 0;
      for (vtkIdType i = 0; i < found->GetNumberOfTuples(); ++i)
      {
        missing += std::isnan(found->GetComponent(i, 0)) ? 1 : 0;
        for (int k = 0; k < 3 && !std::isnan(found->GetComponent(i, 0)); ++k)
        {
          ASSERT_NEAR(found->GetComponent(i, k), factor * expected[k], 1e-5) << name << i;
        }
      }
      EXPECT_EQ(missing, without);
    }
  }

  vtkNew<vtkStreamingPoisson> Poisson;
};

} // namespace

TEST_F(VtkOrdinaryMesh, QuadsAreTriangles)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(30, 20);
  plane->SetOrigin(0.0, 0.0, 0.0);
  plane->SetPoint1(30.0, 0.0, 0.0);
  plane->SetPoint2(0.0, 20.0, 5.0);
  plane->Update();
  this->expectLinear(plane->GetOutput(), 0);
}

TEST_F(VtkOrdinaryMesh, HexahedraAreTetrahedra)
{
  this->expectLinear(hexahedra(8), 1);
}

TEST_F(VtkOrdinaryMesh, PiecesWithoutSomeOfTheirPointsAreOrdinary)
{
  // As a filter leaves them that takes points away: numbers with gaps, in no order, and those of a
  // file, which is not this mesh.
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(30, 20);
  plane->Update();
  vtkNew<vtkDataSetTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  triangles->Update();
  vtkPointSet* mesh = triangles->GetOutput();
  const vtkIdType points = mesh->GetNumberOfPoints();
  vtkNew<vtkIdTypeArray> ids, original;
  ids->SetName("GlobalIds");
  original->SetName("OriginalId");
  for (vtkIdType i = 0; i < points; ++i)
  {
    ids->InsertNextValue(3 * ((11 * i) % points) + 5);
    original->InsertNextValue(points - i);
  }
  mesh->GetPointData()->SetGlobalIds(ids);
  mesh->GetPointData()->AddArray(original);
  ASSERT_TRUE(lacksStreamNumbering(*mesh));
  Errors errors(this->Poisson);
  vtkPointSet* output = this->solve(mesh);
  ASSERT_TRUE(errors.text().empty()) << errors.text();
  for (vtkIdType i = 0; i < points; ++i)
  {
    const double* p = output->GetPoint(i);
    ASSERT_NEAR(
      output->GetPointData()->GetArray("Solution")->GetTuple1(i), p[0] + 2.0 * p[1] - p[2], 1e-6);
    ASSERT_EQ(output->GetPointData()->GetGlobalIds()->GetTuple1(i), ids->GetValue(i));
    ASSERT_EQ(output->GetPointData()->GetArray("OriginalId")->GetTuple1(i), original->GetValue(i));
  }
  // An id is a GlobalId where there are any, and else the number of a point.
  for (const bool hasIds : { true, false })
  {
    vtkNew<vtkMeshRegion> region;
    const auto input = vtkSmartPointer<vtkPointSet>::Take(mesh->NewInstance());
    input->ShallowCopy(mesh);
    if (!hasIds)
    {
      input->GetPointData()->RemoveArray("GlobalIds");
    }
    region->SetInputDataObject(input);
    region->SetRegion(vtkMeshRegion::IDS);
    region->AddId(hasIds ? ids->GetValue(7) : 7);
    updatePiece(region, 0, 1);
    vtkDataArray* held = vtkPointSet::SafeDownCast(region->GetOutputDataObject(0))
                           ->GetPointData()
                           ->GetArray("RegionMask");
    ASSERT_TRUE(held);
    for (vtkIdType i = 0; i < points; ++i)
    {
      ASSERT_EQ(held->GetTuple1(i), i == 7 ? 1.0 : 0.0) << i << ", " << hasIds;
    }
  }
  // Two pieces that are joined have numbers twice.
  for (vtkIdType i = 0; i < points; ++i)
  {
    ids->SetValue(i, i % (points / 2));
  }
  EXPECT_TRUE(lacksStreamNumbering(*mesh));
  // Numbers in the order in which cells use the points, from any on.
  vtkIdType next = 1000;
  ids->FillComponent(0, -1);
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType point = mesh->GetCell(cell)->GetPointId(k);
      ids->SetValue(point, ids->GetValue(point) < 0 ? next++ : ids->GetValue(point));
    }
  }
  EXPECT_FALSE(lacksStreamNumbering(*mesh));
  std::swap(*ids->GetPointer(0), *ids->GetPointer(points - 1));
  EXPECT_TRUE(lacksStreamNumbering(*mesh));
}

TEST_F(VtkOrdinaryMesh, AGridOfTetrahedraHasGradients)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(9, 8, 7);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(image);
  tetrahedra->Update();
  this->Poisson->SetGradient(true);
  this->Poisson->SetGradientAtPoints(true);
  this->Poisson->AddIntegral("*");
  vtkUnstructuredGrid* mesh = tetrahedra->GetOutput();
  this->expectLinear(mesh, 0);
  auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(output->GetCellData()),
         static_cast<vtkDataSetAttributes*>(output->GetPointData()) })
  {
    vtkDataArray* gradient = data->GetArray("Gradient");
    ASSERT_TRUE(gradient);
    for (vtkIdType i = 0; i < gradient->GetNumberOfTuples(); ++i)
    {
      ASSERT_NEAR(gradient->GetComponent(i, 0), 1.0, 1e-5);
      ASSERT_NEAR(gradient->GetComponent(i, 1), 2.0, 1e-5);
      ASSERT_NEAR(gradient->GetComponent(i, 2), -1.0, 1e-5);
    }
  }
  EXPECT_NE(std::string(this->Poisson->GetReport()).find("\"integrals\""), std::string::npos);
}

TEST_F(VtkOrdinaryMesh, GradientsOfOtherCellsAreMeansOverTheirParts)
{
  this->Poisson->SetGradient(true);
  this->Poisson->SetFlux(true);
  this->Poisson->SetConductivity(3.0);
  vtkNew<vtkPlaneSource> quads;
  quads->SetResolution(6, 5);
  quads->Update();
  // A plane has no gradient along its normal, z.
  this->expectLinear(quads->GetOutput(), 0);
  this->expectGradient(1.0, 2.0, 0.0, 0);
  // A line among them has none at all, and no part in the problem.
  vtkNew<vtkPolyData> mixed;
  mixed->SetPoints(quads->GetOutput()->GetPoints());
  mixed->SetPolys(quads->GetOutput()->GetPolys());
  vtkNew<vtkCellArray> line;
  line->InsertNextCell({ 0, 8 });
  mixed->SetLines(line);
  this->expectLinear(mixed, 0);
  this->expectGradient(1.0, 2.0, 0.0, 1);
  this->expectLinear(hexahedra(4), 1);
  this->expectGradient(1.0, 2.0, -1.0, 0);
}

TEST_F(VtkOrdinaryMesh, OfSolidsAndSurfacesTheSolidsCount)
{
  auto grid = hexahedra(4);
  const vtkIdType face[4] = { 0, 1, 6, 5 };
  grid->InsertNextCell(VTK_QUAD, 4, face);
  this->Poisson->SetGradient(true);
  this->expectLinear(grid, 1);
  EXPECT_NE(std::string(this->Poisson->GetNotes()).find("1 points, lines and surface cells"),
    std::string::npos)
    << this->Poisson->GetNotes();
}

TEST_F(VtkOrdinaryMesh, ASphereOfParaViewTakesConditions)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(30);
  vtkNew<vtkPlane> below, above;
  below->SetOrigin(0.0, 0.0, -0.4);
  below->SetNormal(0.0, 0.0, 1.0);
  above->SetOrigin(0.0, 0.0, 0.4);
  above->SetNormal(0.0, 0.0, -1.0);
  vtkNew<vtkMeshCondition> cold, hot;
  cold->SetInputConnection(sphere->GetOutputPort());
  cold->SetRegionFunction(below);
  cold->SetValue(-1.0);
  hot->SetInputConnection(cold->GetOutputPort());
  hot->SetRegionFunction(above);

  hot->SetValue(1.0);
  this->Poisson->SetInputConnection(hot->GetOutputPort());
  for (const int pieces : { 1, 3 })
  {
    Errors errors(this->Poisson);
    updatePiece(this->Poisson, 0, pieces);
    ASSERT_TRUE(errors.text().empty()) << errors.text();
    auto* output = vtkPolyData::SafeDownCast(this->Poisson->GetOutputDataObject(0));
    ASSERT_EQ(output->GetNumberOfPoints(), 40 * 28 + 2);
    vtkDataArray* solution = output->GetPointData()->GetArray("Solution");
    ASSERT_TRUE(solution);
    double held = 1.0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double z = std::fabs(output->GetPoint(i)[2]);
      held = z >= 0.4 ? std::min(held, z) : held;
    }
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      // Between both, the harmonic function of the sphere is an odd one of the height.
      const double z = output->GetPoint(i)[2];
      const double height = std::min(std::fabs(z), held);
      const double expected = std::atanh(2.0 * height) / std::atanh(2.0 * held);
      EXPECT_NEAR(solution->GetTuple1(i), std::copysign(expected, z), 0.01) << z;
    }
  }
}

/** As of a .vtu file in ParaView's own reader, which has texts, or the numbers of their characters.
 */
TEST_F(VtkOrdinaryMesh, FieldArraysNameGroups)
{
  const std::string groups = R"({"groups":[{"name":"low","number":1,"of":"vertices"},)"
                             R"({"name":"high","number":2,"of":"vertices"}],"sets":[[0],[1]]})";
  vtkNew<vtkStringArray> text;
  text->InsertNextValue(groups);
  vtkNew<vtkUnsignedCharArray> characters;
  for (const char c : groups)
  {
    characters->InsertNextValue(static_cast<unsigned char>(c));
  }
  const auto solved = [&](vtkAbstractArray* field, unsigned short highest)
  {
    const vtkNew<vtkUnstructuredGrid> mesh = hexahedra(2);
    vtkNew<vtkUnsignedShortArray> sets;
    sets->SetName("VertexGroups");
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const double z = mesh->GetPoint(i)[2];
      sets->InsertNextValue(z == 0 ? 1 : z == 2 ? highest : 0);
    }
    mesh->GetPointData()->AddArray(sets);
    field->SetName("MeshGroups");
    mesh->GetFieldData()->AddArray(field);
    vtkNew<vtkStreamingPoisson> poisson;
    poisson->SetInputData(mesh);
    poisson->SetProblem(
      R"({"dirichlet": [{"group": "low", "value": 0}, {"group": "high", "value": 1}]})");
    const Errors errors(poisson);
    poisson->Update();
    if (!errors.text().empty())
    {
      return errors.text();
    }
    auto* output = vtkPointSet::SafeDownCast(poisson->GetOutputDataObject(0));
    vtkDataArray* solution = output->GetPointData()->GetArray("Solution");
    for (vtkIdType i = 0; i < 27; ++i)
    {
      EXPECT_NEAR(solution->GetTuple1(i), output->GetPoint(i)[2] / 2, 0.2) << i;
    }
    return std::string();
  };
  EXPECT_EQ(solved(text, 2), "");
  EXPECT_EQ(solved(characters, 2), "");
  EXPECT_PRED_FORMAT2(
    ::testing::IsSubstring, "a set of groups in its array VertexGroups", solved(text, 9));
}

TEST_F(VtkOrdinaryMesh, ConditionsBeforeAJoinAreRefused)
{
  vtkNew<vtkAppendPolyData> both;
  vtkNew<vtkPlane> below;
  for (const double x : { 0.0, 3.0 })
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(x, 0.0, 0.0);
    vtkNew<vtkMeshCondition> condition;
    condition->SetInputConnection(sphere->GetOutputPort());
    condition->SetRegionFunction(below);
    condition->SetValue(x);
    both->AddInputConnection(condition->GetOutputPort());
  }
  this->Poisson->SetInputConnection(both->GetOutputPort());
  Errors errors(this->Poisson);
  updatePiece(this->Poisson, 0, 1);
  EXPECT_TRUE(errors.contain("put them behind that filter")) << errors.text();
}

TEST_F(VtkOrdinaryMesh, DistancesAreThoseInMemoryAndThroughFiles)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(40, 40);
  vtkNew<vtkStreamingDistance> distance;
  distance->SetInputConnection(plane->GetOutputPort());
  distance->SetFrom("{\"nearest\": [[-0.5, -0.5, 0]]}");
  std::vector<double> inMemory;
  const TemporaryFolder scratch;
  for (const std::string& folder : { std::string(), scratch.path().string() })
  {
    distance->SetScratchDirectory(folder.c_str());
    Errors errors(distance);
    updatePiece(distance, 0, 1);
    ASSERT_TRUE(errors.text().empty()) << errors.text();
    auto* output = vtkPointSet::SafeDownCast(distance->GetOutputDataObject(0));
    vtkDataArray* found = output->GetPointData()->GetArray("Distance");
    ASSERT_TRUE(found);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double* p = output->GetPoint(i);
      EXPECT_NEAR(found->GetTuple1(i), std::hypot(p[0] + 0.5, p[1] + 0.5), 0.01);
      if (folder.empty())
      {
        inMemory.push_back(found->GetTuple1(i));
      }
      EXPECT_EQ(found->GetTuple1(i), inMemory[static_cast<std::size_t>(i)]);
    }
  }
}

} // namespace smg::testing
