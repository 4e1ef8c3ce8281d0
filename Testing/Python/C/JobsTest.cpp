// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Python/C/CInterface.h"
#include "smg/Blend.h"
#include "smg/Convert.h"
#include "smg/DeformationDescription.h"
#include "smg/DescriptionFiles.h"
#include "smg/Distance.h"
#include "smg/Smooth.h"
#include "smg/Solve.h"

#include <algorithm>
#include <functional>

// A job through the C interface gives the bits of the function of the library, in the order of the
// arrays.

namespace smg::testing
{
namespace
{

/** A torus in a random order, with patches and values at the vertices. */
struct JobMesh
{
  JobMesh()
    : mesh(shuffled(torus(40, 24, 0.1)))
    , handle(openMesh(this->mesh))
  {
    for (std::int64_t v = 0; v < this->mesh.vertices(); ++v)
    {
      const double x = this->mesh.positions[static_cast<std::size_t>(3 * v)];
      this->patch.push_back(x > 0.0 ? 1 : 2);
      this->value.push_back(x * x + (x > 0.0 ? 0.5 : 0.0));
    }
    const smg_array patches = arrayOf(this->patch), values = arrayOf(this->value);
    expectOk(smg_add_column(this->handle.get(), "patch", 0, &patches, nullptr, nullptr));
    expectOk(smg_add_column(this->handle.get(), "value", 0, &values, nullptr, nullptr));
  }

  IndexedTestMesh mesh;
  std::vector<std::int32_t> patch;
  std::vector<double> value;
  MeshHandle handle;
};

/** The values of a solution in the order of the arrays. */
std::vector<double> ordered(const StoredMesh& mesh, Solution& solution)
{
  const auto columns = static_cast<std::size_t>(solution.columns());
  std::vector<double> values(columns * static_cast<std::size_t>(mesh.info().vertices)), block;
  const auto source = mesh.source({ OriginalIdName }, {});
  for (MeshBlock part; source->next(part);)
  {
    block.resize(columns * static_cast<std::size_t>(part.vertices()));
    solution.read(part.firstVertex, part.vertices(), block);
    for (std::size_t i = 0; i < static_cast<std::size_t>(part.vertices()); ++i)
    {
      const auto row =
        static_cast<std::size_t>(part.vertexColumns[0].as<std::int64_t>()[i]) * columns;
      std::copy_n(&block[i * columns], columns, &values[row]);
    }
  }
  return values;
}

/** The mesh as a .vsm file in breadth-first order with its columns, made without arrays: a .vsm
 * file that smg_save_mesh() writes. */
std::unique_ptr<OpenedMesh> stored(const JobMesh& given, const TemporaryFolder& folder)
{
  const std::filesystem::path path = folder / "mesh.vsm";
  expectOk(smg_save_mesh(given.handle.get(), path.c_str(), nullptr, nullptr, nullptr, nullptr));
  return smg::openMesh(path);
}

void expectSame(const char* job, const std::string& description, const char* column,
  const std::function<std::unique_ptr<Solution>(const StoredMesh&)>& function)
{
  const TemporaryFolder folder;
  const JobMesh given;
  const std::unique_ptr<OpenedMesh> mesh = stored(given, folder);
  const std::unique_ptr<Solution> solution = function(*mesh);
  const FieldHandle field = run(given.handle.get(), job, description);
  ASSERT_TRUE(field);
  std::int64_t vertices = 0, columns = 0;
  expectOk(smg_shape(field.get(), &vertices, &columns));
  EXPECT_EQ(vertices, given.mesh.vertices());
  EXPECT_EQ(columns, solution->columns());
  EXPECT_EQ(read<double>(nullptr, field.get(), column, false, static_cast<int>(columns), vertices),
    ordered(*mesh, *solution));
}

const char* const Problem =
  R"({"dirichlet": [{"sphere": [2, 0, 0, 1.5], "value": 0}, {"vertices": [7], "value": 1}],
      "source": 0.5})";

TEST(CJobs, SolveHasTheBitsOfTheLibrary)
{
  expectSame("solve", std::string(R"({"tolerance": 1e-9, "problem": )") + Problem + "}", "Solution",
    [](const StoredMesh& mesh)
    {
      SolveOptions options;
      options.tolerance = 1e-9;
      return solve(mesh, readProblemText(Problem, "problem"), options);
    });
}

TEST(CJobs, DeformHasTheBitsOfTheLibrary)
{
  const std::string handles =
    R"({"handles": [{"region": {"sphere": [3, 0, 0, 1]}, "fixed": true},
                    {"region": {"sphere": [-3, 0, 0, 1]}, "translate": [0, 0, 1]}]})";
  expectSame("deform", R"({"cycles": 3, "handles": )" + handles + "}", "Position",
    [&](const StoredMesh& mesh)
    {
      DeformOptions options;
      DeformationDescription description = readHandleText(handles, "handles");
      description.cycles = 3;
      return deform(mesh, description, options);
    });
}

TEST(CJobs, SmoothHasTheBitsOfTheLibrary)
{
  expectSame("smooth", R"({"size": "6edges", "hold": {"sphere": [3, 0, 0, 1]}})", "Position",
    [](const StoredMesh& mesh)
    {
      SmoothingDescription description;
      description.size = { 6.0, SmoothingSize::MeanEdges };
      description.hold = { Region::Sphere{ { 3, 0, 0 }, 1 } };
      return smooth(mesh, description);
    });
}

TEST(CJobs, BlendHasTheBitsOfTheLibrary)
{
  expectSame("blend", R"({"patch": "patch", "columns": ["value"], "seam": "average"})", "value",
    [](const StoredMesh& mesh)
    {
      BlendDescription description;
      description.patch = "patch";
      description.columns = { "value" };
      description.seam = SeamGradient::Average;
      return blend(mesh, description);
    });
}

TEST(CJobs, DistanceHasTheBitsOfTheLibrary)
{
  expectSame("distance", R"({"from": [{"vertices": [5]}, {"nearest": [[3, 0, 0]]}]})", "Distance",
    [](const StoredMesh& mesh)
    {
      DistanceDescription description;
      description.from = { Region::Vertices{ { 5 } }, NearestVertices{ { { 3, 0, 0 } } } };
      return distance(mesh, description);
    });
}

TEST(CJobs, AFieldOutlivesItsMeshAndKeepsTheColumnsThatItWasComputedWith)
{
  JobMesh given;
  const FieldHandle field = run(given.handle.get(), "solve",
    R"({"problem": {"dirichlet": [{"tag": ["patch", 1], "value": "value"}]}})");
  const std::vector<double> others(given.value.size(), 7.0);
  const smg_array array = arrayOf(others);
  expectOk(smg_add_column(given.handle.get(), "value", 0, &array, nullptr, nullptr));
  given.handle.reset();
  const std::vector<double> solution =
    read<double>(nullptr, field.get(), "Solution", false, 1, given.mesh.vertices());
  for (std::size_t v = 0; v < solution.size(); ++v)
  {
    if (given.patch[v] == 1)
    {
      EXPECT_EQ(solution[v], given.value[v]);
    }
  }
  EXPECT_EQ(
    read<double>(nullptr, field.get(), "value", false, 1, given.mesh.vertices()), given.value);
}

TEST(CJobs, AReportHasWhatFollowsFromTheResultIfThatIsAskedFor)
{
  const JobMesh given;
  const FieldHandle field = run(given.handle.get(), "solve",
    R"({"problem": {"dirichlet": [{"vertices": [3], "value": 0}, {"vertices": [7], "value": 1}]}})");
  const char* text = nullptr;
  expectOk(smg_report(field.get(), 0, nullptr, nullptr, &text));
  const nlohmann::json first = nlohmann::json::parse(text);
  EXPECT_EQ(first.at("vertices"), given.mesh.vertices());
  EXPECT_FALSE(first.contains("conditions"));
  const nlohmann::json whole = reportOf(field.get());
  EXPECT_EQ(whole.at("conditions").size(), 2u);
  EXPECT_EQ(whole.at("residuals"), first.at("residuals"));
  // By the maximum principle.
  EXPECT_EQ(whole.at("maximum").at(0).at("vertex"), 7);
}

TEST(CJobs, GradientsAreColumnsOfTheCells)
{
  const JobMesh given;
  const FieldHandle field = run(given.handle.get(), "solve",
    R"({"problem": {"outputs": ["gradient"], "dirichlet":
        [{"vertices": [0], "value": 0}, {"vertices": [1], "value": 1}]}})");
  const std::vector<std::string> cells = columnNames(nullptr, field.get(), "cells");
  EXPECT_TRUE(std::ranges::count(cells, "Gradient") == 1);
  const std::int64_t count = given.mesh.cells();
  const std::vector<double> gradient =
    read<double>(nullptr, field.get(), "Gradient", true, 3, count);
  const std::vector<double> u =
    read<double>(nullptr, field.get(), "Solution", false, 1, given.mesh.vertices());
  // Along an edge the difference of u is the gradient times the edge.
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c)
  {
    const auto a = static_cast<std::size_t>(given.mesh.corners[3 * c]);
    const auto b = static_cast<std::size_t>(given.mesh.corners[3 * c + 1]);
    double along = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      along +=
        gradient[3 * c + k] * (given.mesh.positions[3 * b + k] - given.mesh.positions[3 * a + k]);
    }
    EXPECT_NEAR(along, u[b] - u[a], 1e-12);
  }
}

} // namespace
} // namespace smg::testing
