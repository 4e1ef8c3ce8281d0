// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "Testing/Filters/LinearSolution.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

// Points at which nothing is solved for have no number, and a warning says so.

namespace smg::testing
{

TEST(VtkPointsWithoutResult, ThoseOfCellsWithoutAreaAreWarnedOf)
{
  // As a clip through points of the mesh leaves them: a coincident point, of a flat cell.
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(30, 20);
  plane->Update();
  vtkPolyData* mesh = plane->GetOutput();
  const vtkIdType middle = mesh->GetNumberOfPoints() / 2;
  const vtkIdType flat[] = { middle, mesh->GetPoints()->InsertNextPoint(mesh->GetPoint(middle)),
    middle + 1 };
  mesh->GetPolys()->InsertNextCell(3, flat);
  mesh->GetPointData()->Initialize();
  mesh->DeleteCells();
  vtkNew<vtkStreamingPoisson> poisson;
  Errors errors(poisson);
  vtkDataArray* solution = solveLinear(*poisson, mesh)->GetPointData()->GetArray("Solution");
  EXPECT_TRUE(std::isnan(solution->GetTuple1(flat[1])));
  EXPECT_FALSE(std::isnan(solution->GetTuple1(flat[0])));
  EXPECT_NE(errors.text().find("1 vertex belongs to no cell that has a weight"), std::string::npos)
    << errors.text();
  EXPECT_NE(
    errors.text().find("1 cell without area or volume joins coincident points"), std::string::npos)
    << errors.text();
}

TEST(VtkPointsWithoutResult, ThoseOfCellsOfHigherOrderThatAreNoCornersAreWarnedOf)
{
  constexpr int Side = 21; // points, of which every other one is a corner
  vtkNew<vtkPoints> points;
  for (int i = 0; i < Side * Side; ++i)
  {
    points->InsertNextPoint(i % Side, i / Side, 0.0);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  for (int y = 1; y < Side; y += 2)
  {
    for (int x = 1; x < Side; x += 2)
    {
      const vtkIdType m = y * Side + x; // the middle of two triangles
      const vtkIdType lower[] = { m - Side - 1, m - Side + 1, m + Side + 1, m - Side, m + 1, m };
      const vtkIdType upper[] = { m - Side - 1, m + Side + 1, m + Side - 1, m, m + Side, m - 1 };
      grid->InsertNextCell(VTK_QUADRATIC_TRIANGLE, 6, lower);
      grid->InsertNextCell(VTK_QUADRATIC_TRIANGLE, 6, upper);
    }
  }
  vtkNew<vtkStreamingPoisson> poisson;
  Errors errors(poisson);
  vtkDataArray* solution = solveLinear(*poisson, grid)->GetPointData()->GetArray("Solution");
  for (int i = 0; i < Side * Side; ++i)
  {
    const int x = i % Side, y = i / Side;
    const bool isCorner = x % 2 == 0 && y % 2 == 0;
    ASSERT_EQ(std::isnan(solution->GetTuple1(i)), !isCorner) << i;
    EXPECT_TRUE(!isCorner || std::abs(solution->GetTuple1(i) - (x + 2.0 * y)) < 1e-6) << i;
  }
  EXPECT_NE(
    errors.text().find("200 cells of higher order count by their corners"), std::string::npos)
    << errors.text();
}

TEST(VtkPointsWithoutResult, KeepIntegersThatAreNotDoubles)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(12, 9);
  plane->Update();
  vtkPolyData* mesh = plane->GetOutput();
  mesh->GetPoints()->InsertNextPoint(3.0, 4.0, 5.0);
  mesh->GetPointData()->Initialize();
  const vtkIdType loose = mesh->GetNumberOfPoints() - 1;
  const vtkTypeInt64 odd = (vtkTypeInt64(1) << 53) + 1;
  vtkNew<vtkTypeInt64Array> labels;
  labels->SetName("Label");
  for (vtkIdType i = 0; i < loose; ++i)
  {
    labels->InsertNextValue(i % 7);
  }
  labels->InsertNextValue(odd);
  mesh->GetPointData()->AddArray(labels);
  vtkNew<vtkStreamingMeshSmoothing> smoothing;
  const Errors warnings(smoothing);
  smoothing->SetInputDataObject(mesh);
  smoothing->SetArray("Label");
  ASSERT_TRUE(updatePiece(smoothing, 0, 1));
  auto* smoothed = vtkTypeInt64Array::SafeDownCast(
    smoothing->GetPolyDataOutput()->GetPointData()->GetArray("Label"));
  ASSERT_TRUE(smoothed);
  EXPECT_EQ(smoothed->GetValue(loose), odd);
}

} // namespace smg::testing
