// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingBlend.h"
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshDeformation.h"
#include "Filters/vtkStreamingMeshSimplification.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "IO/Conversion/JobEstimate.h"
#include "IO/Simplification/SimplifiedMesh.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "Solver/Core/Text.h"
#include "Solver/Jobs/Estimate/Costs.h"
#include "Testing/Filters/PoissonFixture.h"
#include "smg/VsmReader.h"

#include "vtkCellType.h"
#include "vtkCellTypeSource.h"
#include "vtkPlaneSource.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>

namespace smg::testing
{
namespace
{

class VtkSolveEstimate : public VtkStreamingPoisson
{
protected:
  VtkSolveEstimate() { this->open(torus(400, 100, 0.2)); }

  /** The estimate of the filter is that of a solve for so many right-hand sides. */
  void expectEstimateOf(int columns)
  {
    const VsmReader mesh(this->Folder / "mesh.vsm");
    SolveOptions options;
    options.tolerance = this->Poisson->GetTolerance();
    const Costs costs = solveCosts(mesh.info(), columns, Weights::Cotangent, options);
    const std::string text = this->Poisson->GetEstimate();
    const auto expectPart = [&text](const std::string& part)
    { EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text; };
    expectPart("About " + mebibytes(costs.memory) + " of memory (the limit is 1024 MiB), ");
    expectPart(mebibytes(costs.scratch + mesh.storedBytes()) + " of scratch files");
    expectPart(std::to_string(costs.passes) + " passes over 40,000 points and 80,000 cells");
    ProblemDescription problem;
    problem.columns = columns;
    const JobEstimate saved(
      EstimatedInput(mesh.path(), {}), { "result.vsm", solvedValues(problem) }, costs, {});
    expectPart("saved as .vsm " + mebibytes(saved.output_bytes));
  }
};

TEST_F(VtkSolveEstimate, IsKnownBeforeAnythingIsRequested)
{
  EXPECT_TRUE(
    std::string(this->Poisson->GetEstimate()).starts_with("Not known: the filter before"));
  this->Poisson->UpdateInformation();
  // The number of components of the values is not known before the filter before has executed.
  this->expectEstimateOf(1);
  EXPECT_EQ(this->Ends->Executions, 0);
  this->Poisson->SetProblem(R"({"columns": 4})");
  this->expectEstimateOf(4);
  EXPECT_EQ(this->Ends->Executions, 0);
  this->Poisson->SetProblem(nullptr);
  ASSERT_TRUE(updatePiece(this->Ends, 0, 100));
  this->expectEstimateOf(3);
}

TEST_F(VtkSolveEstimate, DoesNotChangeAResult)
{
  this->Poisson->SetGradient(true);
  ASSERT_TRUE(updatePiece(this->Poisson, 0, 9));
  this->Ends->GetOutputDataObject(0)->ReleaseData();
  this->Poisson->GetEstimate();
  ASSERT_TRUE(updatePiece(this->Poisson, 1, 9));
  vtkDataArray* gradient = this->output()->GetCellData()->GetArray("Gradient");
  ASSERT_TRUE(gradient);
  EXPECT_EQ(gradient->GetNumberOfComponents(), 9);
}

TEST_F(VtkSolveEstimate, OfEveryFilter)
{
  vtkNew<vtkStreamingMeshDeformation> deformation;
  vtkNew<vtkStreamingMeshSmoothing> smoothing;
  vtkNew<vtkStreamingBlend> blend;
  vtkNew<vtkStreamingDistance> distance;
  blend->AddColumn("Colours");
  for (vtkStreamingSolver* filter :
    std::initializer_list<vtkStreamingSolver*>{ deformation, smoothing, blend, distance })
  {
    filter->SetInputConnection(this->Ends->GetOutputPort());
    filter->SetScratchLimit(77);
    filter->UpdateInformation();
    const std::string text = filter->GetEstimate();
    EXPECT_TRUE(text.starts_with("About ")) << filter->GetClassName() << ": " << text;
    EXPECT_NE(text.find("scratch files (the limit is 77 MiB, "), std::string::npos) << text;
    EXPECT_NE(text.find("over 40,000 points"), std::string::npos) << text;
  }
  EXPECT_EQ(this->Ends->Executions, 0);
  distance->SetFrom("nowhere");
  EXPECT_TRUE(std::string(distance->GetEstimate()).starts_with("Not known: "));
}

TEST_F(VtkSolveEstimate, OfASimplification)
{
  vtkNew<vtkStreamingMeshSimplification> filter;
  filter->SetInputConnection(this->Ends->GetOutputPort());
  const auto text = [&filter] { return std::string(filter->GetEstimate()); };
  EXPECT_TRUE(text().starts_with("Not known: the filter before")) << text();
  filter->UpdateInformation();
  EXPECT_NE(text().find("2 passes over 40,000 points and 80,000 cells"), std::string::npos)
    << text();
  // The filter before changes the mesh, so that it is copied.
  const VsmReader mesh(this->Folder / "mesh.vsm");
  const SimplifyOptions options{ .memoryLimit = std::int64_t(256) << 20 };
  const JobEstimate expected = simplifyEstimate(
    EstimatedInput(mesh.path(), {}), { .vertices = 1000 }, "simplified.vsm", options, {});
  filter->SetNumberOfVertices(1000);
  EXPECT_TRUE(text().ends_with("saved as .vsm " + mebibytes(expected.output_bytes))) << text();
  EXPECT_NE(
    text().find(", " + mebibytes(mesh.storedBytes() + expected.output_bytes) + " of scratch files"),
    std::string::npos)
    << text();
  filter->SetNumberOfVertices(0);
  EXPECT_TRUE(text().starts_with("Not known: Nothing says how far to simplify")) << text();
  EXPECT_EQ(this->Ends->Executions, 0);
}

/** An OBJ file has no counts, so that they are guessed from its size. */
TEST_F(VtkSolveEstimate, OfAMeshThatHasBeenConvertedHasItsCounts)
{
  const std::string name = (this->Folder / "mesh.obj").string();
  const IndexedTestMesh mesh = torus(40, 25, 0.2);
  std::ofstream file(name);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
  {
    file << (i % 3 == 0 ? "\nv " : " ") << mesh.positions[i];
  }
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    file << (i % 3 == 0 ? "\nf " : " ") << mesh.corners[i] + 1;
  }
  file.close();
  vtkNew<vtkStreamingMeshConverter> converter;
  converter->SetFileName(name.c_str());
  converter->SetOutputFileName((this->Folder / "kept.vsm").c_str());
  vtkNew<vtkStreamingMeshReader> reader;
  reader->SetFileName(name.c_str());
  for (vtkStreamingMeshReader* source :
    std::initializer_list<vtkStreamingMeshReader*>{ converter, reader })
  {
    this->Ends->SetInputConnection(source->GetOutputPort());
    this->Poisson->UpdateInformation();
    const auto isCounted = [](const std::string& text)
    { return text.find("1,000 points and 2,000 cells") != std::string::npos; };
    EXPECT_FALSE(isCounted(this->Poisson->GetEstimate())) << this->Poisson->GetEstimate();
    source->Update(); // which tells those behind nothing
    EXPECT_TRUE(isCounted(this->Poisson->GetEstimate())) << this->Poisson->GetEstimate();
  }
  EXPECT_TRUE(std::string(converter->GetEstimate()).starts_with("About 1,000 points and 2,000 "))
    << converter->GetEstimate();
  converter->SetOrder(vtkStreamingMeshConverter::AXIS);
  EXPECT_NE(std::string(converter->GetEstimate()).find("guessed"), std::string::npos);
}

/** The number before a word of a text. */
std::int64_t numberBefore(const std::string& text, const std::string& word)
{
  const std::size_t end = text.find(' ' + word);
  const std::size_t begin = end == std::string::npos ? end : text.rfind(' ', end - 1);
  if (begin == std::string::npos)
  {
    return -1;
  }
  std::string digits = text.substr(begin + 1, end - begin - 1);
  std::erase(digits, ',');
  return std::stoll(digits);
}

TEST(VtkOrdinaryEstimate, HasTheCountsOfTheSolve)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPlaneSource> quads;
  quads->SetResolution(30, 20);
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkCellTypeSource> hexahedra, wedges, pyramids, tetrahedra;
  const std::pair<vtkCellTypeSource*, int> solids[] = { { hexahedra, VTK_HEXAHEDRON },
    { wedges, VTK_WEDGE }, { pyramids, VTK_PYRAMID }, { tetrahedra, VTK_TETRA } };
  for (const auto& [source, type] : solids)
  {
    source->SetCellType(type);
    source->SetBlocksDimensions(5, 4, 3);
  }
  for (vtkAlgorithm* source : std::initializer_list<vtkAlgorithm*>{
         sphere, quads, strips, hexahedra, wedges, pyramids, tetrahedra })
  {
    vtkNew<vtkStreamingDistance> distance;
    distance->SetFrom(R"({"sphere": [0, 0, 0, 0.6]})");
    distance->SetInputConnection(source->GetOutputPort());
    EXPECT_TRUE(std::string(distance->GetEstimate()).starts_with("Not known: the filter before"));
    source->Update();
    const std::string text = distance->GetEstimate();
    EXPECT_TRUE(text.starts_with("About ")) << text;
    distance->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
    distance->Update();
    const auto report = nlohmann::json::parse(distance->GetReport());
    EXPECT_EQ(numberBefore(text, "points"), report["vertices"]) << text;
    const auto cells = report["cells"].get<std::int64_t>();
    EXPECT_GE(numberBefore(text, "cells"), cells) << text;
    EXPECT_LE(numberBefore(text, "cells"), cells * 6 / 5) << text;
  }
}

} // namespace
} // namespace smg::testing
