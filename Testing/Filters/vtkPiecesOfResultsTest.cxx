// SPDX-License-Identifier: BSD-3-Clause
// What filters that have solved serve later: pieces of the same mesh, also with ghost cells.
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshSimplification.h"
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Testing/Filters/HandleTesting.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include "vtkCurvatures.h"
#include "vtkPolyData.h"

#include <map>

namespace smg::testing
{
namespace
{

class VtkPiecesOfResults : public ::testing::Test
{
protected:
  VtkPiecesOfResults()
  {
    writeVsm(this->Path, torus(60, 30, 0.2));
    this->Reader->SetFileName(this->Path.c_str());
    this->Reader->SetMaximumPointsInMemory(100);
    this->Distance->SetInputConnection(this->Reader->GetOutputPort());
    this->Distance->SetFrom(R"({"vertices": [7]})");
    this->Distance->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
    this->Poisson->SetInputConnection(this->Reader->GetOutputPort());
    this->Poisson->SetProblem(R"({"source": [1], "screening": 1})");
    this->Poisson->SetSolve(vtkStreamingSolver::ON_FULL_MESH);
    this->Simplification->SetInputConnection(this->Reader->GetOutputPort());
    this->Simplification->SetNumberOfVertices(500);
  }

  static int stream(vtkAlgorithm* filter, int piece, int pieces, int ghostLevels)
  {
    auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(filter->GetExecutive());
    executive->UpdateInformation();
    executive->GetOutputInformation(0)->Set(vtkStreamingMeshKeys::STREAMED(), pieces);
    const int done = updateWithGhosts(filter, piece, pieces, ghostLevels);
    executive->GetOutputInformation(0)->Set(vtkStreamingMeshKeys::STREAMED(), 0);
    return done;
  }

  TemporaryFolder Folder;
  std::filesystem::path Path = this->Folder / "mesh.vsm";
  vtkNew<vtkStreamingMeshReader> Reader;
  vtkNew<vtkStreamingDistance> Distance;
  vtkNew<vtkStreamingPoisson> Poisson;
  vtkNew<vtkStreamingMeshSimplification> Simplification;
};

/** A file that is replaced between a solve and the pieces of its result. */
TEST_F(VtkPiecesOfResults, OfAFileThatIsReplacedAreErrors)
{
  for (vtkAlgorithm* filter : std::initializer_list<vtkAlgorithm*>{ this->Distance, this->Poisson })
  {
    writeVsm(this->Path, torus(60, 30, 0.2));
    this->Reader->Modified();
    ASSERT_TRUE(stream(filter, 0, 3, 0));
    writeVsm(this->Folder / "other.vsm", torus(60, 30, 0.1));
    std::filesystem::rename(this->Folder / "other.vsm", this->Path);
    Errors errors(this->Reader);
    errors.watch(filter);
    EXPECT_FALSE(stream(filter, 1, 3, 0)) << filter->GetClassName();
    EXPECT_TRUE(errors.contain("mesh.vsm: was replaced or changed")) << errors.text();
    errors.clear();
    this->Reader->Modified();
    EXPECT_TRUE(stream(filter, 1, 3, 0)) << filter->GetClassName();
    EXPECT_EQ(errors.text(), "");
  }
}

/** The own parts of pieces with ghosts are the pieces without, and ghosts have the values of their
 * owners. */
TEST_F(VtkPiecesOfResults, HaveTheGhostsThatAreAskedFor)
{
  const std::pair<vtkAlgorithm*, const char*> filters[] = { { this->Distance, "Distance" },
    { this->Poisson, "Solution" }, { this->Simplification, nullptr } };
  for (const auto& [filter, name] : filters)
  {
    constexpr int Pieces = 4;
    std::map<std::int64_t, std::vector<double>> all;
    std::int64_t own[3] = {}, others[3] = {};
    for (int levels = 0; levels < 3; ++levels)
    {
      for (int piece = 0; piece < Pieces; ++piece)
      {
        ASSERT_TRUE(stream(filter, piece, Pieces, levels));
        auto* output = vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0));
        vtkDataArray* ids = output->GetPointData()->GetGlobalIds();
        vtkDataArray* array = name ? output->GetPointData()->GetArray(name) : nullptr;
        ASSERT_TRUE(ids && (array || !name));
        for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
        {
          std::vector<double> values(3);
          output->GetPoint(i, values.data());
          values.push_back(array ? array->GetTuple1(i) : 0.0);
          const auto id = static_cast<std::int64_t>(ids->GetTuple1(i));
          EXPECT_EQ(all.emplace(id, values).first->second, values) << filter->GetClassName();
        }
        vtkUnsignedCharArray* ghosts = output->GetCellGhostArray();
        EXPECT_EQ(ghosts != nullptr, levels > 0);
        for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
        {
          ++(ghosts && ghosts->GetValue(c) != 0 ? others : own)[levels];
        }
      }
    }
    EXPECT_EQ(others[0], 0);
    EXPECT_GT(others[1], 0) << filter->GetClassName();
    EXPECT_GT(others[2], others[1]);
    EXPECT_EQ(own[1], own[0]);
    EXPECT_EQ(own[2], own[0]);
  }
}

/** Behind the filter, curvature in pieces is that of the whole, without a warning. */
TEST_F(VtkPiecesOfResults, AreRightThroughFiltersOfNeighbours)
{
  this->Reader->SetMaximumPointsInMemory(100);
  const vtkNew<vtkCurvatures> before, behind;
  before->SetInputConnection(this->Reader->GetOutputPort());
  this->Distance->SetInputConnection(before->GetOutputPort());
  behind->SetInputConnection(this->Distance->GetOutputPort());
  StreamMesh whole;
  for (const int pieces : { 1, 5 })
  {
    const vtkNew<vtkStreamingMeshWriter> writer;
    writer->SetInputConnection(behind->GetOutputPort());
    writer->SetNumberOfStreamedPieces(pieces);
    const std::filesystem::path path = this->Folder / "result.vsm";
    writer->SetFileName(path.c_str());
    const Errors warnings(writer);
    ASSERT_TRUE(writer->Write());
    EXPECT_EQ(warnings.text(), "");
    const StreamMesh mesh = collect(*VsmReader(path).source());
    whole = pieces == 1 ? mesh : whole;
    EXPECT_EQ(mesh.corners, whole.corners);
    ASSERT_EQ(mesh.vertexColumns.size(), whole.vertexColumns.size());
    for (std::size_t c = 0; c < mesh.vertexColumns.size(); ++c)
    {
      EXPECT_EQ(mesh.vertexColumns[c].bytes, whole.vertexColumns[c].bytes)
        << mesh.vertexColumns[c].spec.name;
    }
  }
}

} // namespace
} // namespace smg::testing
