// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include "vtkCurvatures.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkFeatureEdges.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkSmoothPolyDataFilter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace smg::testing
{
namespace
{

using Cell = std::vector<vtkIdType>; ///< GlobalIds, ascending

/** What pieces have that are no ghosts: cells by their points, and tuples of points. */
struct OwnParts
{
  std::multiset<Cell> cells;
  std::map<vtkIdType, std::vector<double>> values;

  /** Adds a piece, with the array of this name if there is one. */
  void add(vtkPointSet& piece, const char* name)
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(piece.GetPointData()->GetArray("GlobalIds"));
    ASSERT_TRUE(ids);
    vtkUnsignedCharArray* ghostCells = piece.GetCellGhostArray();
    for (vtkIdType c = 0; c < piece.GetNumberOfCells(); ++c)
    {
      if (ghostCells && ghostCells->GetValue(c) & vtkDataSetAttributes::DUPLICATECELL)
      {
        continue;
      }
      Cell cell;
      vtkIdList* points = piece.GetCell(c)->GetPointIds();
      for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
      {
        cell.push_back(ids->GetValue(points->GetId(k)));
      }
      std::ranges::sort(cell);
      this->cells.insert(std::move(cell));
    }
    vtkUnsignedCharArray* ghosts = piece.GetPointGhostArray();
    vtkDataArray* array = name ? piece.GetPointData()->GetArray(name) : nullptr;
    for (vtkIdType i = 0; array && i < piece.GetNumberOfPoints(); ++i)
    {
      if (!(ghosts && ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT))
      {
        const double* tuple = array->GetTuple(i);
        this->values[ids->GetValue(i)].assign(tuple, tuple + array->GetNumberOfComponents());
      }
    }
  }
};

class VtkGhostLevels : public ::testing::Test
{
protected:
  StreamMesh open(const IndexedTestMesh& mesh)
  {
    const std::filesystem::path path = this->Folder / "mesh.vsm";
    StreamMesh stream = writeVsm(path, mesh);
    this->Reader->SetFileName(path.c_str());
    this->Reader->Modified();
    return stream;
  }

  static OwnParts partsOf(vtkAlgorithm& filter, int pieces, int ghostLevels, const char* name)
  {
    OwnParts all;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_TRUE(updateWithGhosts(&filter, piece, pieces, ghostLevels));
      auto* output = vtkPointSet::SafeDownCast(filter.GetOutputDataObject(0));
      if (output->GetNumberOfPoints() > 0)
      {
        all.add(*output, name);
      }
    }
    return all;
  }

  /** Expects the own parts of the pieces, with so many ghost levels, to be the whole. */
  void expectWhole(vtkAlgorithm& filter, int ghostLevels, const char* name = nullptr)
  {
    filter.SetInputConnection(this->Reader->GetOutputPort());
    const OwnParts whole = partsOf(filter, 1, 0, name);
    ASSERT_FALSE(whole.cells.empty());
    for (int pieces = 2; pieces <= 7; ++pieces)
    {
      const OwnParts parts = partsOf(filter, pieces, ghostLevels, name);
      std::vector<Cell> missing, added;
      std::ranges::set_difference(whole.cells, parts.cells, std::back_inserter(missing));
      std::ranges::set_difference(parts.cells, whole.cells, std::back_inserter(added));
      EXPECT_EQ(missing, std::vector<Cell>()) << filter.GetClassName() << " in " << pieces;
      EXPECT_EQ(added, std::vector<Cell>()) << filter.GetClassName() << " in " << pieces;
      EXPECT_EQ(parts.values, whole.values) << filter.GetClassName() << " in " << pieces;
    }
  }

  TemporaryFolder Folder;
  vtkNew<vtkStreamingMeshReader> Reader;
};

TEST_F(VtkGhostLevels, OwnPartsAreThePieces)
{
  for (const bool isSolid : { false, true })
  {
    const StreamMesh mesh = this->open(isSolid ? tetBox(6, 6, 5, 0.1) : torus(20, 14, 0.2));
    for (int pieces = 1; pieces <= 7; ++pieces)
    {
      const OwnParts plain = partsOf(*this->Reader, pieces, 0, "Colours");
      EXPECT_EQ(std::int64_t(plain.cells.size()), mesh.cells());
      for (const int levels : { 1, 2, 1000 })
      {
        const OwnParts parts = partsOf(*this->Reader, pieces, levels, "Colours");
        EXPECT_EQ(parts.cells, plain.cells) << pieces << ' ' << levels;
        EXPECT_EQ(parts.values, plain.values) << pieces << ' ' << levels;
        auto* last = vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
        // A thousand layers are all of the mesh.
        EXPECT_EQ(last->GetNumberOfCells() == mesh.cells(), pieces == 1 || levels == 1000);
      }
    }
  }
}

TEST_F(VtkGhostLevels, FiltersOfVtkAreRightInPieces)
{
  this->open(torus(20, 14, 0.2));
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SplittingOff();
  normals->ConsistencyOff();
  this->expectWhole(*normals, 1, "Normals");
  const vtkNew<vtkCurvatures> curvatures;
  curvatures->SetCurvatureTypeToGaussian();
  this->expectWhole(*curvatures, 1, "Gauss_Curvature");
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0) // that of VTK 9.1 does not look at ghost cells
  this->open(grid(17, 13, 0.1));
  const vtkNew<vtkFeatureEdges> edges; // asks for a level by itself
  this->expectWhole(*edges, 0);
#endif
  this->open(tetBox(6, 6, 5, 0.1));
  const vtkNew<vtkDataSetSurfaceFilter> surface;
  this->expectWhole(*surface, 1);
}

/** The writer requests the ghost cells that filters between may need, and leaves them out. */
TEST_F(VtkGhostLevels, AStreamThroughFiltersIsThatOfTheWhole)
{
  this->open(torus(40, 24, 0.2));
  this->Reader->SetMaximumPointsInMemory(10);
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->SetInputConnection(this->Reader->GetOutputPort());
  const vtkNew<vtkCurvatures> curvatures;
  curvatures->SetCurvatureTypeToGaussian();
  curvatures->SetInputConnection(normals->GetOutputPort());
  StreamMesh whole;
  for (const int pieces : { 1, 2, 5, 9 })
  {
    const vtkNew<vtkStreamingMeshWriter> writer;
    writer->SetInputConnection(curvatures->GetOutputPort());
    writer->SetNumberOfStreamedPieces(pieces);
    const std::filesystem::path path = this->Folder / "curved.vsm";
    writer->SetFileName(path.c_str());
    const Errors warnings(writer);
    ASSERT_TRUE(writer->Write());
    EXPECT_EQ(warnings.text(), "") << pieces;
    const StreamMesh mesh = collect(*VsmReader(path).source());
    whole = pieces == 1 ? mesh : whole;
    EXPECT_EQ(mesh.corners, whole.corners);
    ASSERT_EQ(mesh.vertexColumns.size(), whole.vertexColumns.size());
    for (std::size_t c = 0; c < whole.vertexColumns.size(); ++c)
    {
      EXPECT_EQ(mesh.vertexColumns[c].spec, whole.vertexColumns[c].spec);
      EXPECT_EQ(mesh.vertexColumns[c].bytes, whole.vertexColumns[c].bytes)
        << whole.vertexColumns[c].spec.name << " in " << pieces;
    }
  }
}

/** What depends on more than neighbours is found by what pieces say of the points of both. */
TEST_F(VtkGhostLevels, WhatIsWrongAtTheBordersIsSaid)
{
  this->open(torus(40, 24, 0.2));
  this->Reader->SetMaximumPointsInMemory(10);
  const vtkNew<vtkSmoothPolyDataFilter> smoothing;
  smoothing->SetNumberOfIterations(30);
  smoothing->SetInputConnection(this->Reader->GetOutputPort());
  for (const char* name : { "smooth.vsm", "smooth.pvtp" })
  {
    for (const int pieces : { 1, 4 })
    {
      const vtkNew<vtkStreamingMeshWriter> writer;
      writer->SetInputConnection(smoothing->GetOutputPort());
      writer->SetNumberOfStreamedPieces(pieces);
      writer->SetFileName((this->Folder / name).c_str());
      const Errors warnings(writer);
      ASSERT_TRUE(writer->Write());
      EXPECT_EQ(warnings.contain("in pieces through Smooth Poly Data Filter"), pieces > 1)
        << warnings.text();
    }
  }
}

} // namespace
} // namespace smg::testing
