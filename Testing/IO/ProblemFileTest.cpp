// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/ParseWhere.h"
#include "Solver/Problem/ProblemData.h"
#include "smg/DescriptionFiles.h"

#include "Testing/IO/RegionFileFixture.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TestFolders.h"
#include "smg/DescribedProblem.h"

#include <set>

namespace smg::testing
{
namespace
{

class ProblemFile : public RegionFile
{
protected:
  /** The values of the problem of a file on the lattice. */
  ProblemAnswers ask(const std::string& json)
  {
    return this->ask(readProblemFile(this->file(json)), this->Source);
  }
  static ProblemAnswers ask(const ProblemDescription& description, MemorySource& source)
  {
    DescribedProblem problem(description, source.info());
    source.rewind(BlockCells);
    problem.prepare(source);
    source.rewind(BlockCells);
    return answersOf(problem, source);
  }

  std::string errorOf(const std::string& json)
  {
    const std::string message = messageOf(
      [&]
      {
        const ProblemDescription description = readProblemFile(this->file(json));
        DescribedProblem problem(description, this->Source.info(), "p.json");
        this->Source.rewind(BlockCells);
        problem.prepare(this->Source);
      });
    return message.empty() ? "no error" : message;
  }
};

/** Objects of the schema `docs/problem.schema.json`. */
nlohmann::json schema()
{
  return readJsonFile(sourceFolder() / "docs/problem.schema.json");
}

std::set<std::string> keysOf(const nlohmann::json& properties)
{
  std::set<std::string> keys;
  for (const auto& item : properties.items())
  {
    keys.insert(item.key());
  }
  return keys;
}

} // namespace

TEST_F(ProblemFile, DefaultsAndValues)
{
  const ProblemDescription empty = readProblemFile(this->file("{}"));
  EXPECT_EQ(empty.columns, 1);
  EXPECT_EQ(empty.weights, Weights::Cotangent);
  const ProblemDescription full = readProblemFile(this->file(
    R"({"weights": "uniform", "columns": 2, "source": [1, -2.5], "screening": 0.25,
        "outputs": ["flux", "gradient at vertices"], "integrals": ["chip *", 7]})"));
  EXPECT_EQ(full.columns, 2);
  EXPECT_EQ(full.weights, Weights::Uniform);
  EXPECT_TRUE(full.fluxOutput && !full.gradientOutput && full.vertexGradientOutput);
  EXPECT_EQ(full.integrals, std::vector<std::string>({ "chip *", "7" }));
  ProblemDescription askable = full;
  askable.integrals = { "*" }; // the mesh has no groups
  const ProblemAnswers answers = this->ask(askable, this->Source);
  EXPECT_EQ(answers.vertices.screening[24], 0.25);
  EXPECT_EQ(answers.vertices.source[0], 1.0);
  EXPECT_EQ(answers.vertices.source[49], -2.5);
  EXPECT_EQ(answers.vertices.dirichlet[3], -1);
  EXPECT_EQ(
    readProblemFile(this->file(R"({"weights": "raw-cotangent"})")).weights, Weights::Cotangent);
  EXPECT_EQ(readProblemFile(this->file(R"({"weights": "clamped"})")).weights, Weights::Clamped);
}

TEST_F(ProblemFile, LaterRegionsWinAndVerticesHaveOriginalNumbers)
{
  const VertexConditions conditions = this
                                        ->ask(R"({"columns": 1, "dirichlet": [
    {"halfspace": [1, 0, 0, 2], "value": [1]},
    {"box": [2, 0, 0, 2.6, 9, 0], "value": [2]},
    {"sphere": [0, 0, 0, 0.5], "value": [3]},
    {"vertices": [1003, 1003], "value": [4]}]})")
                                        .vertices;
  const StreamMesh& mesh = this->Source.mesh();
  for (std::size_t i = 0; i < 25; ++i)
  {
    const double x = mesh.positions[3 * i];
    const double y = mesh.positions[3 * i + 1];
    double expected = x >= 2 ? 1 : 0;
    expected = x >= 2 && x <= 2.6 ? 2 : expected;
    expected = x * x + y * y <= 0.25 ? 3 : expected;
    expected = i == 21 ? 4 : expected;
    EXPECT_EQ(conditions.dirichlet[i], static_cast<int>(expected) - 1);
    EXPECT_EQ(conditions.value[i], expected);
  }
}

TEST_F(ProblemFile, PositionIsValueAndGuess)
{
  const VertexConditions conditions = this
                                        ->ask(R"({"columns": 3, "dirichlet": [
    {"vertices": [1000], "value": "position"}, {"vertices": [1024], "value": [7, 8, 9]}]})")
                                        .vertices;
  EXPECT_EQ(conditions.dirichlet[24], 0);
  EXPECT_EQ(conditions.dirichlet[0], 1);
  EXPECT_EQ(conditions.value[1], 8.0);
  for (std::size_t i = 3; i < 75; ++i)
  {
    EXPECT_EQ(conditions.value[i], this->Source.mesh().positions[i]);
  }
}

TEST_F(ProblemFile, EveryDatumSaysTheSameInJsonAndInCxx)
{
  ProblemDescription same;
  same.weights = Weights::Clamped;
  same.columns = 3;
  same.conductivity = { { Everywhere{}, DataValue{ 2, 3, 4, 0.5, 0.25, 0.125 } },
    { ColumnTag{ "tag", 3 }, "K" }, { Region::Box{ { 1.5, -1, -1 }, { 9, 9, 9 } }, 2.5 },
    { ColumnMask{ "cellMask" }, "k" } };
  same.screening = { { Everywhere{}, 0.5 },
    { NearestVertices{ { { 1, 1, 1 }, { 2, 0, 0 } } }, "one" } };
  same.source = { { Everywhere{}, DataValue{ 1, 2, 3 } },
    { Region::HalfSpace{ { 0, 0, 1 }, 1.5 }, "three" }, { Region::Sphere{ {}, 1.5 }, Position{} } };
  same.field = "q";
  same.initial = "three";
  same.dirichlet = { { ColumnTag{ "tag", 3 }, Position{} }, { ColumnMask{ "mask" }, "three" },
    { Region::Vertices{ { 3, 7 } }, DataValue{ 4, 5, 6 } } };
  same.flux = { { Region::Box{ { -9, -9, -9 }, { 9, 9, 0.5 } }, DataValue{ 1, 0, 2 } },
    { ColumnMask{ "cellMask" }, "q" } };
  same.robin = { { Region::HalfSpace{ { 1, 0, 0 }, 2.5 }, 2.0, DataValue{ 3, 4, 5 } },
    { ColumnMask{ "mask" }, { { Everywhere{}, "one" }, { ColumnTag{ "tag", 3 }, "k" } },
      Position{} } };
  same.soft = { { ColumnMask{ "mask" }, 3.0, "three" },
    { ColumnTag{ "tag", 1 }, "one", DataValue{ 1, 1, 1 } }, { OnBoundary{}, 0.5, Position{} } };
  same.gradientOutput = same.fluxOutput = true;

  const ProblemDescription parsed = readProblemFile(this->file(EveryDatumOfDescribedMesh));
  EXPECT_EQ(parsed.weights, same.weights);
  EXPECT_TRUE(parsed.gradientOutput && parsed.fluxOutput);
  MemorySource mesh(describedMesh());
  EXPECT_TRUE(this->ask(parsed, mesh) == this->ask(same, mesh));
  const auto solved = [&](const ProblemDescription& description)
  {
    DescribedProblem problem(description, mesh.info());
    mesh.rewind(BlockCells);
    problem.prepare(mesh);
    mesh.rewind(BlockCells);
    return solveMesh(mesh, problem, {}).values;
  };
  EXPECT_TRUE(sameBits(solved(parsed), solved(same)));
}

TEST_F(ProblemFile, TheSchemaHasTheKeysOfTheParser)
{
  const nlohmann::json all = schema();
  EXPECT_EQ(
    keysOf(all["properties"]), std::set<std::string>(ProblemKeys.begin(), ProblemKeys.end()));
  EXPECT_EQ(keysOf(all["$defs"]["regionOrColumn"]["properties"]),
    std::set<std::string>(WhereKeys.begin(), WhereKeys.end()));
}

TEST_F(ProblemFile, ErrorsOfCoefficients)
{
  for (const char* bad : { "0", "-2", "\"\"", "[1]", "[]", "null", "1e999", "[1, 1, 1, 2, 0, 0]" })
  {
    EXPECT_CONTAINS(this->errorOf(std::string(R"({"conductivity": )") + bad + "}"), "p.json");
  }
  EXPECT_CONTAINS(this->errorOf(R"({"conductivity": 0})"), "conductivity: must be a positive");
  EXPECT_CONTAINS(this->errorOf(R"({"conductivity": [1]})"), "must be an array of 6 numbers");
  EXPECT_CONTAINS(
    this->errorOf(R"({"conductivity": "k"})"), "conductivity: the mesh has no column 'k'");
  EXPECT_CONTAINS(this->errorOf(R"({"conductivity": [{"value": 1}, {"value": 0}]})"),
    "conductivity[1].value: must be a positive");
  EXPECT_CONTAINS(this->errorOf(R"({"conductivity": [{"value": [{"value": 1}]}]})"),
    "conductivity[0].value: must be an array of 6 numbers");
  EXPECT_CONTAINS(this->errorOf(R"({"weights": "uniform", "conductivity": 2})"),
    "conductivity: goes with cotangent and clamped weights only");
  EXPECT_CONTAINS(
    this->errorOf(R"({"screening": -1})"), "screening: must be finite and not negative");
  EXPECT_CONTAINS(this->errorOf(R"({"screening": [1]})"), "screening: must be a finite number");
  EXPECT_CONTAINS(this->errorOf(R"({"screening": ""})"), "screening: must be the name of a column");
  EXPECT_CONTAINS(
    this->errorOf(R"({"robin": [{"box": [0,0,0,1,1,1], "coefficient": -1, "ambient": [0]}]})"),
    "robin[0].coefficient: must be finite and not negative");
}

TEST_F(ProblemFile, ErrorsNameThePlace)
{
  EXPECT_CONTAINS(this->errorOf(R"({"weight": "uniform"})"), "weight: is not known");
  EXPECT_CONTAINS(this->errorOf(R"({"weights": "heat"})"), "weights: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 0})"), "columns: must be");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 1.5})"), "columns: must be");
  EXPECT_CONTAINS(
    this->errorOf(R"({"columns": 2, "source": 1})"), "source: must be an array of 2 numbers");
  EXPECT_CONTAINS(this->errorOf(R"({"source": true})"), "source: must be an array of 1 number");
  EXPECT_CONTAINS(this->errorOf(R"({"source": [1e999]})"), "overflow parsing '1e999'");
  EXPECT_CONTAINS(
    this->errorOf(R"({"initial": "position"})"), "initial: can be \"position\" only if");
  EXPECT_CONTAINS(this->errorOf(R"({"field": [1, 0, 0]})"), "field: must be a string");
  EXPECT_CONTAINS(this->errorOf(R"({"outputs": ["heat"]})"),
    "outputs[0]: must be \"gradient\", \"flux\" or \"gradient at vertices\"");
  EXPECT_CONTAINS(this->errorOf(R"({"integrals": [1.5]})"), "integrals[0]: must be a string");
  EXPECT_CONTAINS(this->errorOf(R"({"integrals": ["chip"]})"),
    "integrals[0]: the mesh has no groups, so none is called 'chip'");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": {}})"), "dirichlet: must be an array");
  EXPECT_CONTAINS(
    this->errorOf(R"({"dirichlet": [{"mask": "a", "box": [0, 0, 0, 1, 1, 1], "value": [0]}]})"),
    "dirichlet[0]: must have at most one of halfspace, box, sphere, vertices, tag, mask, "
    "nearest, boundary, group, all, any and not");
  EXPECT_CONTAINS(this->errorOf(R"({"source": [{"mask": "a", "nearest": [], "value": [0]}]})"),
    "source[0]: must have at most one of halfspace");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"sphere": [0, 0, 0, 9]}]})"), "has no 'value'");
  EXPECT_CONTAINS(this->errorOf(R"({"soft": [{"mask": "m", "value": [0]}]})"), "has no 'weight'");
  EXPECT_CONTAINS(this->errorOf(R"({"flux": [{"mask": "m", "value": [0], "ambient": [0]}]})"),
    "flux[0].ambient: is not known");
  EXPECT_CONTAINS(this->errorOf(R"({"flux": [{"tag": ["a"], "value": [0]}]})"),
    "flux[0].tag: must be [\"name of a column\", value]");
  EXPECT_CONTAINS(this->errorOf(R"({"flux": [{"boundary": false, "value": [0]}]})"),
    "flux[0].boundary: can only be true");
  EXPECT_CONTAINS(this->errorOf(R"({"flux": [{"nearest": [[0, 0]], "value": [0]}]})"),
    "flux[0].nearest[0]: must be an array of 3 numbers");
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
  EXPECT_CONTAINS(
    this->errorOf("{\n\"columns\": }"), "p.json: this is not valid JSON: parse error at line 2");
  EXPECT_CONTAINS(this->errorOf(R"({"columns": 1, "columns": 2})"), "'columns' occurs twice");
  EXPECT_CONTAINS(this->errorOf(R"({"dirichlet": [{"value": [0], "value": [1]}]})"), "'value'");
  EXPECT_CONTAINS(this->errorOf(""), "empty");
  EXPECT_CONTAINS(this->errorOf("[]"), "must be an object");
}

TEST_F(ProblemFile, ErrorsOfCouplings)
{
  const std::pair<const char*, const char*> cases[] = {
    { R"({"periodic": [["left"]]})", "periodic[0]: must have two sides" },
    { R"({"periodic": [{"jump": 1}]})", "periodic[0]: has no 'sides'" },
    { R"({"periodic": [{"sides": ["a", "b"], "jumps": 1}]})", "jumps" },
    { R"({"periodic": [["a", {"box": [0, 0, 0, 1, 1, 1], "value": 1}]]})", "value" },
    { R"({"periodic": [{"sides": ["a", "b"], "tolerance": 0}]})", "tolerance: must be positive" },
    { R"({"interface": {"coefficient": 1}})", "must have exactly one of halfspace" },
    { R"({"interface": [{"group": "gap", "coefficient": -1}]})",
      "interface[0].coefficient: must not be negative" },
    { R"({"weights": "clamped", "interface": {"box": [0, 0, 0, 1, 1, 1], "coefficient": 1}})",
      "interface: goes with cotangent weights only" },
    { R"({"periodic": [["left", "right"]]})", "the mesh has no groups" },
  };
  for (const auto& [json, message] : cases)
  {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, message, this->errorOf(json));
  }
}

TEST_F(ProblemFile, WhatSelectsNothingIsFound)
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
  DescribedProblem problem(
    readProblemFile(this->file(R"({"dirichlet": [{"vertices": [15], "value": [1]}]})")),
    plain.info());
  EXPECT_TRUE(problem.vertexColumns().empty());
  EXPECT_NO_THROW(problem.prepare(plain));
}

TEST_F(ProblemFile, PlacesStandAloneOrInAList)
{
  const auto places = [&](const std::string& json) { return readPlacesFile(this->file(json)); };
  ASSERT_EQ(places(R"({"boundary": true})").size(), 1U);
  EXPECT_TRUE(std::holds_alternative<OnBoundary>(places(R"({"boundary": true})")[0]));
  const std::vector<Where> two =
    readPlacesText(R"([{"tag": ["part", 3]}, {"sphere": [0, 0, 0, 1]}])", "--hold");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(std::get<ColumnTag>(two[0]).value, 3.0);
  EXPECT_TRUE(std::holds_alternative<Region>(two[1]));
  const auto error = [](const char* text)
  { return messageOf([text] { readPlacesText(text, "--hold"); }); };
  EXPECT_CONTAINS(error("[]"), "--hold: must have at least one place: leave it out for none");
  EXPECT_CONTAINS(error("{}"), "--hold: must have exactly one of halfspace");
  const std::vector<Where> all = readPlacesText(R"([{"everywhere": true}])", "--hold");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Everywhere>(all[0]));
  EXPECT_CONTAINS(error(R"({"everywhere": false})"), "--hold: everywhere can only be true");
  EXPECT_CONTAINS(error(R"({"everywhere": true, "boundary": true})"), "and stands alone");
  EXPECT_CONTAINS(error("[3]"), "--hold: [0]: must be an object");
  EXPECT_CONTAINS(error(R"({"boundary": true, "value": 3})"), "--hold: value: is not known here");
}

} // namespace smg::testing
