// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/RegionProblem.h"

#include "Testing/IO/RegionFileFixture.h"

namespace smg::testing
{
namespace
{

class ProblemFile : public RegionFile
{
protected:
  std::unique_ptr<RegionProblem> parse(const std::string& json)
  {
    return readProblemFile(this->file(json), this->Source.info());
  }

  std::string errorOf(const std::string& json)
  {
    return RegionFile::errorOf(readProblemFile, json);
  }

  /** What the problem says of all vertices. */
  VertexConditions ask(RegionProblem& problem)
  {
    VertexConditions all;
    this->Source.rewind(7);
    for (MeshBlock block; this->Source.next(block);)
    {
      VertexConditions some;
      const auto vertices = static_cast<std::size_t>(block.vertices());
      const auto columns = static_cast<std::size_t>(problem.columns());
      some.dirichlet.assign(vertices, -1);
      some.screening.assign(vertices, 0.0);
      some.value.assign(vertices * columns, 0.0);
      some.source.assign(vertices * columns, 0.0);
      problem.conditions(block, some);
      all.dirichlet.insert(all.dirichlet.end(), some.dirichlet.begin(), some.dirichlet.end());
      all.screening.insert(all.screening.end(), some.screening.begin(), some.screening.end());
      all.value.insert(all.value.end(), some.value.begin(), some.value.end());
      all.source.insert(all.source.end(), some.source.begin(), some.source.end());
    }
    return all;
  }
};

} // namespace

TEST_F(ProblemFile, DefaultsAndValues)
{
  const auto empty = this->parse("{}");
  EXPECT_EQ(empty->columns(), 1);
  EXPECT_EQ(empty->weights(), Weights::Cotangent);
  EXPECT_EQ(this->ask(*empty).screening[7], 0.0);
  const auto full =
    this->parse(R"({"weights": "uniform", "columns": 2, "source": [1, -2.5], "screening": 0.25})");
  EXPECT_EQ(full->columns(), 2);
  EXPECT_EQ(full->weights(), Weights::Uniform);
  const VertexConditions conditions = this->ask(*full);
  EXPECT_EQ(conditions.source[0], 1.0);
  EXPECT_EQ(conditions.source[49], -2.5);
  EXPECT_EQ(conditions.screening[24], 0.25);
  EXPECT_EQ(conditions.dirichlet[3], -1);
}

TEST_F(ProblemFile, LaterRegionsWin)
{
  const auto problem = this->parse(R"({"columns": 1, "dirichlet": [
    {"halfspace": [1, 0, 0, 2], "value": [1]},
    {"box": [2, 0, 0, 2.6, 9, 0], "value": [2]},
    {"sphere": [0, 0, 0, 0.5], "value": [3]},
    {"vertices": [1003, 1003], "value": [4]}]})");
  const VertexConditions conditions = this->ask(*problem);
  const StreamMesh& mesh = this->Source.mesh();
  for (std::size_t i = 0; i < 25; ++i)
  {
    const double x = mesh.positions[3 * i];
    const double y = mesh.positions[3 * i + 1];
    double expected = x >= 2 ? 1 : 0;
    expected = x >= 2 && x <= 2.6 ? 2 : expected;
    expected = x * x + y * y <= 0.25 ? 3 : expected;
    expected = i == 21 ? 4 : expected;
    EXPECT_EQ(conditions.dirichlet[i], expected > 0 ? 0 : -1);
    EXPECT_EQ(conditions.value[i], expected);
  }
}

TEST_F(ProblemFile, PositionIsValueAndGuess)
{
  const auto problem = this->parse(R"({"columns": 3, "dirichlet": [
    {"vertices": [1000], "value": "position"}, {"vertices": [1024], "value": [7, 8, 9]}]})");
  const VertexConditions conditions = this->ask(*problem);
  EXPECT_EQ(conditions.dirichlet[24], 0);
  EXPECT_EQ(conditions.dirichlet[0], 0);
  EXPECT_EQ(conditions.value[1], 8.0);
  for (std::size_t i = 3; i < 75; ++i)
  {
    EXPECT_EQ(conditions.value[i], this->Source.mesh().positions[i]);
  }
}

TEST_F(ProblemFile, ConductivityIsANumberOrACellColumn)
{
  StreamMesh mesh = lattice();
  std::vector<float> factors;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    factors.push_back(c == 20 ? -1.0F : 0.5F + static_cast<float>(c));
  }
  mesh.cellColumns.push_back(
    makeColumn<std::uint8_t>(CellFlagsName, std::vector<std::uint8_t>(32)));
  mesh.cellColumns.push_back(makeColumn<float>("k", factors));
  MemorySource source(mesh, 32);
  MeshBlock block;
  source.next(block);
  // What becomes of the weights of cells [10, 10 + count).
  const auto weightsOf = [&](const std::string& json, std::size_t count)
  {
    const auto problem = readProblemFile(this->file(json), source.info());
    EXPECT_TRUE(problem->hasCells());
    std::vector<double> weight(3 * count, 2.0);
    std::vector<double> measure(count, 1.0);
    CellBatch batch{ CellType::Triangle, block, 10, {}, {}, weight, measure, {}, {}, {}, {} };
    problem->cells(batch);
    EXPECT_EQ(measure, std::vector<double>(count, 1.0));
    return weight;
  };
  EXPECT_EQ(weightsOf(R"({"conductivity": 0.25})", 1), std::vector<double>(3, 0.5));
  EXPECT_EQ(
    weightsOf(R"({"conductivity": "k"})", 2), (std::vector<double>{ 21, 21, 21, 23, 23, 23 }));
  EXPECT_CONTAINS(messageOf([&] { weightsOf(R"({"conductivity": "k"})", 11); }),
    "conductivity: it must be a positive number in each cell, but is -1");
  EXPECT_CONTAINS(
    messageOf([&] { weightsOf(R"({"conductivity": "k"})", 11); }), "in cell 20 of the stream");

  using Names = std::vector<std::string>;
  const auto columnsOf = [&](const std::string& json)
  { return readProblemFile(this->file(json), source.info())->cellColumns(); };
  EXPECT_EQ(columnsOf(R"({"conductivity": "k"})"), Names{ "k" });
  EXPECT_EQ(columnsOf(R"({"conductivity": 2})"), Names{});
  EXPECT_FALSE(this->parse(R"({"conductivity": 1})")->hasCells());
}

TEST_F(ProblemFile, ErrorsOfTheConductivity)
{
  for (const char* bad : { "0", "-2", "\"\"", "[1]", "null", "1e999" })
  {
    EXPECT_CONTAINS(this->errorOf(std::string(R"({"conductivity": )") + bad + "}"), "p.json");
  }
  EXPECT_CONTAINS(this->errorOf(R"({"conductivity": 0})"), "conductivity: must be a positive");
  EXPECT_CONTAINS(
    this->errorOf(R"({"conductivity": "k"})"), "conductivity: the mesh has no cell column 'k'");
  EXPECT_CONTAINS(this->errorOf(R"({"weights": "uniform", "conductivity": 2})"),
    "conductivity: can be given with cotangent weights only");
}

TEST_F(ProblemFile, ErrorsNameThePlace)
{
  EXPECT_CONTAINS(this->errorOf(R"({"weight": "uniform"})"), "weight: is not known");
  EXPECT_CONTAINS(this->errorOf(R"({"weights": "heat"})"), "weights: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 0})"), "columns: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 1.5})"), "columns: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"screening": -1})"), "screening: must not");
  EXPECT_CONTAINS(this->errorOf(R"({"screening": "1"})"), "screening: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"source": 1})"), "source: must be an array of 1 number");
  EXPECT_CONTAINS(this->errorOf(R"({"source": [1e999]})"), "out of range");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": {}})"), "dirichlet: must be an array");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"value": [0]}]})"), "exactly one of");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"sphere": [0, 0, 0, 9]}]})"), "has no 'value'");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"sphere": [0, 0, 0, -1], "value": [0]}]})"), "radius");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"sphere": [0, 0, 0, 1], "value": "position"}]})"),
    "only if there are 3 columns");
  const std::string sound = R"({"sphere": [0, 0, 0, 1], "value": [0]})";
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [)" + sound + R"(, {"box": [1, 2, 3], "value": [0]}]})"),
    "dirichlet[1].box: must be an array of 6 numbers");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"box": [1, 0, 0, 0, 1, 1], "value": [0]}]})"), "x0 <= x1");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"vertices": [-1], "value": [0]}]})"), "vertices[0]");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"vertices": [18446744073709551615], "value": [0]}]})"),
    "vertices[0]");
  EXPECT_CONTAINS(this->errorOf("{\n\"columns\": }"), "p.json, line 2");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 1, "columns": 2})"), "'columns' stands twice");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"value": [0], "value": [1]}]})"), "'value'");
  EXPECT_CONTAINS(this->errorOf(""), "empty");
  EXPECT_CONTAINS(this->errorOf("[]"), "must be an object");
}

TEST_F(ProblemFile, CheckFindsWhatSelectsNothing)
{
  EXPECT_EQ(
    this->errorOf(R"({"dirichlet": [{"vertices": [1000, 1024], "value": [0]}]})"), "no error");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"vertices": [1000, 1025], "value": [0]}]})"), "number 1025");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"sphere": [0, 0, 50, 1], "value": [0]}]})"),
    "dirichlet[0]: no vertex");
}

TEST_F(ProblemFile, WithoutOriginalNumbersTheStreamCounts)
{
  MemorySource plain(toStream(grid(4, 4)), 3);
  writeBytes(this->Folder / "p.json", R"({"dirichlet": [{"vertices": [15], "value": [1]}]})");
  const auto problem = readProblemFile(this->Folder / "p.json", plain.info());
  EXPECT_TRUE(problem->vertexColumns().empty());
  EXPECT_NO_THROW(problem->check(plain));
}

} // namespace smg::testing
