// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"
#include "Filters/vtkMeshRegion.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/AbortTesting.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Blend.h"
#include "smg/VsmReader.h"

#include "vtkFieldData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace smg::testing
{
namespace
{

class VtkStreamingBlend : public ::testing::Test
{
protected:
  VtkStreamingBlend()
  {
    this->open(torus(60, 30, 0.2));
    this->Blend->SetInputConnection(this->Reader->GetOutputPort());
    this->Blend->SetNumberOfPieces(5);
    this->Blend->SetScratchDirectory(this->Folder.path().c_str());
    this->Blend->SetPatch("patch");
    this->Blend->AddColumn("light");
    this->Blend->AddColumn("heat");
  }

  /** A mesh with two patches of the vertices and of the cells, and columns with a step. */
  void open(const IndexedTestMesh& mesh)
  {
    this->Mesh = toStream(mesh);
    addColumns(this->Mesh);
    std::vector<std::int32_t> patch, cellPatch;
    std::vector<std::uint8_t> light;
    std::vector<double> heat;
    for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
    {
      const double* p = &this->Mesh.positions[3 * v];
      patch.push_back(p[0] > 0.1 ? 7 : -2);
      const double step = p[0] > 0.1 ? 60.0 : 0.0;
      light.push_back(static_cast<std::uint8_t>(100 + step + 10 * p[1]));
      light.push_back(static_cast<std::uint8_t>(180 - step));
      heat.push_back(std::sin(p[1]) + step);
    }
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      cellPatch.push_back(patch[this->Mesh.corners[cornersOf(mesh.cellType) * c]]);
    }
    this->Mesh.vertexColumns.push_back(makeColumn<std::int32_t>("patch", patch));
    this->Mesh.vertexColumns.push_back(makeColumn<std::uint8_t>("light", light, 2));
    this->Mesh.vertexColumns.push_back(makeColumn<double>("heat", heat));
    this->Mesh.cellColumns.push_back(makeColumn<std::int32_t>("cellPatch", cellPatch));
    const std::string name = "mesh" + std::to_string(this->Folder.entries()) + ".vsm";
    writeMesh(this->Folder / name, this->Mesh);
    this->Reader->SetFileName((this->Folder / name).c_str());
  }

  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->Blend->GetOutputDataObject(0)); }

  BlendDescription description() const
  {
    BlendDescription description;
    description.patch = "patch";
    description.columns = { "light", "heat" };
    return description;
  }

  /** Expects the values that blend() computes, in the types of the arrays, in so many pieces. */
  void expectBlended(const BlendDescription& description, int pieces)
  {
    const std::unique_ptr<Solution> solution = blend(MemoryMesh(this->Mesh), description);
    std::vector<double> values(static_cast<std::size_t>(3 * solution->vertices()));
    solution->read(0, solution->vertices(), values);
    for (int piece = 0; piece < pieces; ++piece)
    {
      ASSERT_TRUE(updatePiece(this->Blend, piece, pieces));
      vtkPointData* points = this->output()->GetPointData();
      auto* light = vtkUnsignedCharArray::SafeDownCast(points->GetArray("light"));
      vtkDataArray* heat = points->GetArray("heat");
      ASSERT_TRUE(light && heat);
      for (vtkIdType i = 0; i < heat->GetNumberOfTuples(); ++i)
      {
        const auto id = static_cast<std::size_t>(points->GetGlobalIds()->GetTuple1(i));
        for (int k = 0; k < 2; ++k)
        {
          const double rounded = std::clamp(std::nearbyint(values[3 * id + k]), 0.0, 255.0);
          ASSERT_EQ(light->GetComponent(i, k), rounded);
        }
        ASSERT_EQ(heat->GetTuple1(i), values[3 * id + 2]);
      }
    }
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingBlend> Blend;
};

TEST_F(VtkStreamingBlend, HoldsWhatMeshRegionsMark)
{
  vtkNew<vtkMeshRegion> region;
  region->SetInputConnection(this->Reader->GetOutputPort());
  region->SetRegion(vtkMeshRegion::IDS);
  region->SetIdType(vtkMeshRegion::ORIGINAL_IDS);
  region->AddId(7);
  this->Blend->SetInputConnection(region->GetOutputPort());
  this->Blend->SetHold(R"({"vertices": [30]})");
  BlendDescription description = this->description();
  description.hold = { Region(Region::Vertices{ { 7 } }), Region(Region::Vertices{ { 30 } }) };
  this->expectBlended(description, 3);
}

TEST_F(VtkStreamingBlend, EveryWayGivesTheValuesOfTheLibrary)
{
  this->expectBlended(this->description(), 1);
  for (const int pieces : { 1, 3, 16 })
  {
    this->expectBlended(this->description(), pieces);
  }
  EXPECT_EQ(this->Blend->GetConverged(), 1);
  EXPECT_NE(std::string(this->Blend->GetReport()).find("\"seams\""), std::string::npos);
}

TEST_F(VtkStreamingBlend, EveryPropertyIsAPartOfTheDescription)
{
  this->open(tetBox(8, 7, 6, 0.1));
  BlendDescription description = this->description();
  description.patch = "cellPatch";
  description.anchor = 3.0;
  description.hold = { Region::Vertices{ { 7 } } };
  this->Blend->SetPatch("cellPatch");
  description.seam = SeamGradient::Average;
  this->Blend->SetAnchor(3.0);
  this->Blend->SetSeamGradient(vtkStreamingBlend::AVERAGE);
  this->Blend->SetHold(R"({"vertices": [7]})");
  for (const int pulled : { 0, 3 })
  {
    this->Blend->SetNumberOfPieces(pulled);
    this->expectBlended(description, 2);
  }
  this->Blend->RemoveAllColumns();
  EXPECT_EQ(this->Blend->GetNumberOfColumns(), 0);
  this->Blend->AddColumn("heat");
  EXPECT_STREQ(this->Blend->GetColumn(0), "heat");
  EXPECT_EQ(this->Blend->GetColumn(1), nullptr);
}

TEST_F(VtkStreamingBlend, WhatIsWrittenIsTheWholeMeshAndAPreviewIsBlendedByItself)
{
  this->Reader->SetMaximumPointsInMemory(100);
  this->Blend->SetSolve(vtkStreamingSolver::ON_PREVIEW);
  this->Reader->SetPreviewPoints(300);
  ASSERT_TRUE(updatePiece(this->Blend, 0, 1));
  EXPECT_TRUE(this->output()->GetFieldData()->HasArray("Preview"));
  EXPECT_LT(this->output()->GetNumberOfPoints(), 600);
  EXPECT_NE(
    std::string(this->Blend->GetNotes()).find("this is the blended preview"), std::string::npos);
  double range[2];
  this->output()->GetPointData()->GetArray("heat")->GetRange(range);
  EXPECT_LT(range[1] - range[0], 20.0); // 60 and more before
  vtkNew<vtkStreamingMeshWriter> writer;
  writer->SetInputConnection(this->Blend->GetOutputPort());
  writer->SetFileName((this->Folder / "out.vsm").c_str());
  ASSERT_TRUE(writer->Write());
  const VsmReader reader(this->Folder / "out.vsm");
  const StreamMesh written = collect(*reader.source());
  EXPECT_EQ(written.positions, this->Mesh.positions);
  const std::unique_ptr<Solution> solution = blend(MemoryMesh(this->Mesh), this->description());
  std::vector<double> values(static_cast<std::size_t>(3 * solution->vertices()));
  solution->read(0, solution->vertices(), values);
  const auto heat = std::ranges::find(
    written.vertexColumns, "heat", [](const Column& column) { return column.spec.name; });
  ASSERT_NE(heat, written.vertexColumns.end());
  for (std::size_t v = 0; v < heat->tuples(); ++v)
  {
    ASSERT_EQ(heat->value(v), values[3 * v + 2]);
  }
}

TEST_F(VtkStreamingBlend, CanBeAborted)
{
  this->Blend->SetSeamGradient(vtkStreamingBlend::AVERAGE);
  expectCanBeAborted(this->Blend.Get(), this->Folder);
}

TEST_F(VtkStreamingBlend, MistakesAreOneErrorEach)
{
  Errors errors(this->Blend);
  const auto expect = [&](const std::string& words, const std::function<void()>& spoil)
  {
    for (const int pulled : { 0, 3 })
    {
      errors.clear();
      this->Blend->SetNumberOfPieces(pulled);
      spoil();
      EXPECT_FALSE(updatePiece(this->Blend, 0, 1));
      EXPECT_TRUE(errors.contain(words)) << errors.text();
      this->Blend->SetPatch("patch");
      this->Blend->SetHold(nullptr);
      this->Blend->SetAnchor(0.01);
      this->Blend->RemoveAllColumns();
      this->Blend->AddColumn("heat");
    }
  };
  expect("Hold: sphere: must be", [&] { this->Blend->SetHold(R"({"sphere": [1]})"); });
  expect("hold[0]: no vertex", [&] { this->Blend->SetHold(R"({"sphere": [9, 9, 9, 1]})"); });
  expect("Missing", [&] { this->Blend->SetPatch("Missing"); });
  expect("Patch must name", [&] { this->Blend->SetPatch(nullptr); });
  expect("Patch must name", [&] { this->Blend->SetPatch("None"); });
  expect("Arrays must name", [&] { this->Blend->RemoveAllColumns(); });
  expect("column of the cells", [&] { this->Blend->AddColumn("cellPatch"); });
  expect("at least 0", [&] { this->Blend->SetAnchor(-1.0); });
}

} // namespace
} // namespace smg::testing
