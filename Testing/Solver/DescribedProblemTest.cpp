// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedProblem.h"

#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/SolveMesh.h"

#include <gtest/gtest.h>

#include <set>

namespace smg::testing
{
namespace
{

const Region Right = Region::HalfSpace{ { 1, 0, 0 }, 1.5 };
const Region Bottom = Region::Box{ { -1, -1, -1 }, { 9, 9, 0.5 } };
const ColumnTag Left{ "tag", 3 };

class Described : public ::testing::Test
{
protected:
  /** The data of the description, which must not depend on blocks and batches. */
  ProblemAnswers ask(const ProblemDescription& description)
  {
    this->Source.rewind(7);
    DescribedProblem problem(description, this->Source.info());
    problem.prepare(this->Source);
    this->Source.rewind(7);
    ProblemAnswers answers = answersOf(problem, this->Source);
    this->Source.rewind(1000);
    EXPECT_TRUE(answersOf(problem, this->Source, 1000) == answers);
    return answers;
  }

  std::string errorOf(const ProblemDescription& description)
  {
    return messageOf([&] { this->ask(description); });
  }

  double x(std::int64_t vertex) const { return this->Mesh.positions[3 * vertex]; }
  double z(std::int64_t vertex) const { return this->Mesh.positions[3 * vertex + 2]; }
  bool isMasked(std::int64_t vertex) const
  {
    return this->Mesh.vertexColumns[2].value(vertex) != 0;
  }
  bool isLeft(std::int64_t cell) const { return this->Mesh.cellColumns[4].value(cell) == 3; }
  /** Whether `holds` for all corners of a cell, optionally except one. */
  bool all(std::int64_t cell, auto holds, int but = -1) const
  {
    bool result = true;
    for (int k = 0; k < 4; ++k)
    {
      result = result && (k == but || holds(this->Mesh.corners[4 * cell + k]));
    }
    return result;
  }
  /** The vertices of the cells on the left. */
  std::set<std::int64_t> leftVertices() const
  {
    std::set<std::int64_t> vertices;
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      if (this->isLeft(c))
      {
        vertices.insert(&this->Mesh.corners[4 * c], &this->Mesh.corners[4 * c] + 4);
      }
    }
    return vertices;
  }
  double one(std::int64_t v) const { return this->Mesh.vertexColumns[0].value(v); }
  double mean(std::int64_t cell) const
  {
    const std::int64_t* corner = &this->Mesh.corners[4 * cell];
    return (this->one(corner[0]) + this->one(corner[1]) + this->one(corner[2]) +
             this->one(corner[3])) /
           4;
  }

  StreamMesh Mesh = describedMesh();
  MemorySource Source{ Mesh };
};

} // namespace

TEST_F(Described, NothingSaidIsTheLaplaceEquation)
{
  ProblemDescription nothing;
  const DescribedProblem problem(nothing, this->Mesh.cells() ? this->Source.info() : StreamInfo());
  EXPECT_EQ(problem.columns(), 1);
  EXPECT_EQ(problem.weights(), Weights::Cotangent);
  EXPECT_FALSE(problem.hasCells() || problem.hasFacets());
  const ProblemAnswers answers = this->ask(nothing);
  const auto count = static_cast<std::size_t>(this->Mesh.vertices());
  EXPECT_EQ(answers.vertices.dirichlet, std::vector<std::int32_t>(count, -1));
  EXPECT_EQ(answers.vertices.value, std::vector<double>(count));
}

TEST_F(Described, ConductivityInEveryForm)
{
  ProblemDescription description;
  const auto expect = [&](const Datum& conductivity, auto expected)
  {
    description.conductivity = conductivity;
    const ProblemAnswers answers = this->ask(description);
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      EXPECT_EQ(answers.weight[6 * c + 5], expected(c));
      EXPECT_EQ(answers.conductivity[6 * c + 2], expected(c));
      EXPECT_EQ(answers.conductivity[6 * c + 4], 0.0);
    }
  };
  const auto isRight = [&](std::int64_t v) { return this->x(v) >= 1.5; };
  const auto isMasked = [&](std::int64_t v) { return this->isMasked(v); };
  expect(2.5, [](std::int64_t) { return 2.5; });
  expect("k", [&](std::int64_t c) { return this->Mesh.cellColumns[0].value(c); });
  expect("one", [&](std::int64_t c) { return this->mean(c); });
  expect({ { Everywhere{}, 2.0 }, { Right, 3.0 } },
    [&](std::int64_t c) { return this->all(c, isRight) ? 3.0 : 2.0; });
  expect({ { Left, 5.0 } }, [&](std::int64_t c) { return this->isLeft(c) ? 5.0 : 1.0; });
  expect({ { Left, 5.0 }, { ColumnMask{ "mask" }, "k" } },
    [&](std::int64_t c)
    {
      return this->all(c, isMasked) ? this->Mesh.cellColumns[0].value(c)
             : this->isLeft(c)      ? 5.0
                                    : 1.0;
    });
  expect({ { ColumnMask{ "cellMask" }, 4.0 }, { Everywhere{}, 7.0 } },
    [&](std::int64_t) { return 7.0; });
}

TEST_F(Described, TensorsAreGivenByTheirNumbersOrTheirDiagonals)
{
  ProblemDescription description;
  description.conductivity = { { Everywhere{}, DataValue{ 2, 3, 4, 0.5, 0.25, 0.125 } },
    { Left, "diagonal" }, { Right, "K" } };
  const ProblemAnswers answers = this->ask(description);
  for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
  {
    const bool isRight = this->all(c, [&](std::int64_t v) { return this->x(v) >= 1.5; });
    const std::vector<double> all{ 2, 3, 4, 0.5, 0.25, 0.125 };
    for (int k = 0; k < 6; ++k)
    {
      const double expected = isRight            ? this->Mesh.cellColumns[2].value(c, k)
                              : !this->isLeft(c) ? all[k]
                              : k < 3            ? this->Mesh.cellColumns[1].value(c, k)
                                                 : 0.0;
      EXPECT_EQ(answers.conductivity[6 * c + k], expected);
    }
  }
}

/** 0.1 in single precision is not 0.1 in double precision, but users write 0.1. */
TEST_F(Described, ATagIsComparedInThePrecisionOfItsColumn)
{
  std::vector<float> tenths(static_cast<std::size_t>(this->Mesh.vertices()), 0.2F);
  tenths[5] = 0.1F;
  this->Mesh.vertexColumns.push_back(makeColumn<float>("tenths", tenths));
  this->Source = MemorySource(this->Mesh);
  ProblemDescription description;
  description.dirichlet = { { ColumnTag{ "tenths", 0.1 }, 1.0 } };
  const ProblemAnswers answers = this->ask(description);
  for (std::size_t v = 0; v < tenths.size(); ++v)
  {
    EXPECT_EQ(answers.vertices.dirichlet[v], v == 5 ? 0 : -1);
  }
}

TEST_F(Described, DensitiesAreOfVerticesUnlessAColumnOfCellsIsNamed)
{
  ProblemDescription description;
  description.columns = 2;
  description.screening = { { Everywhere{}, 0.5 }, { Right, "one" },
    { ColumnMask{ "mask" }, 3.0 } };
  description.source = { { ColumnTag{ "mask", 1 }, DataValue{ 1, 2 } } };
  const ProblemAnswers answers = this->ask(description);
  EXPECT_TRUE(answers.screening.empty());
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    const bool masked = this->isMasked(v);
    EXPECT_EQ(answers.vertices.screening[v], masked ? 3.0 : this->x(v) >= 1.5 ? this->one(v) : 0.5);
    EXPECT_EQ(answers.vertices.source[2 * v + 1], masked ? 2.0 : 0.0);
  }

  description = {};
  description.screening = "k";
  description.source = { { Everywhere{}, "one" }, { Left, 9.0 } };
  const ProblemAnswers ofCells = this->ask(description);
  for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
  {
    EXPECT_EQ(ofCells.screening[c], this->Mesh.cellColumns[0].value(c));
    EXPECT_EQ(ofCells.source[c], this->isLeft(c) ? 9.0 : this->mean(c));
  }
  EXPECT_EQ(ofCells.vertices.source, std::vector<double>(ofCells.vertices.source.size()));
}

/** Of vertices and cells that both have a column, whose it is can be said. */
TEST_F(Described, AColumnIsThatOfTheOwnerThatIsSaid)
{
  using Owner = DataValue::Owner;
  Column ofCells = this->Mesh.cellColumns[0];
  ofCells.spec.name = "one";
  this->Mesh.cellColumns.push_back(ofCells);
  this->Source = MemorySource(this->Mesh);
  for (const Owner owner : { Owner::Usual, Owner::Vertices, Owner::Cells })
  {
    ProblemDescription description;
    description.screening = DataValue{ "one", owner };
    description.conductivity = DataValue{ "one", owner };
    const ProblemAnswers answers = this->ask(description);
    for (std::int64_t v = 0; owner != Owner::Cells && v < this->Mesh.vertices(); ++v)
    {
      EXPECT_EQ(answers.vertices.screening[v], this->one(v));
    }
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      const double expected = ofCells.value(c);
      if (owner == Owner::Cells)
      {
        EXPECT_EQ(answers.screening[c], expected);
      }
      EXPECT_EQ(answers.conductivity[6 * c], owner == Owner::Vertices ? this->mean(c) : expected);
    }
  }
}

TEST_F(Described, AFieldIsOneVectorForAllColumnsOrOneForEach)
{
  ProblemDescription description;
  description.columns = 2;
  description.field = "q";
  const ProblemAnswers shared = this->ask(description);
  description.field = "K";
  const ProblemAnswers each = this->ask(description);
  for (std::int64_t i = 0; i < 6 * this->Mesh.cells(); ++i)
  {
    EXPECT_EQ(shared.field[i], this->Mesh.cellColumns[3].value(i / 6, static_cast<int>(i % 3)));
    EXPECT_EQ(each.field[i], this->Mesh.cellColumns[2].value(i / 6, static_cast<int>(i % 6)));
  }
}

TEST_F(Described, DirichletInEveryFormAndLaterEntriesWin)
{
  ProblemDescription description;
  description.columns = 3;
  const std::array<double, 3> point{ 2.9, 0.1, 1.8 };
  description.dirichlet = { { Left, DataValue{ 1, 2, 3 } }, { ColumnMask{ "mask" }, Position{} },
    { ColumnTag{ "mask", 1 }, "three" }, { Bottom, DataValue{ 4, 5, 6 } },
    { NearestVertices{ { point, point } }, DataValue{ 7, 8, 9 } },
    { Region::Vertices{ { 5, 2, 5 } }, DataValue{ 0, 0, 1 } } };
  description.initial = "three";
  const ProblemAnswers answers = this->ask(description);
  const std::set<std::int64_t> left = this->leftVertices();
  const auto distance = [&](std::int64_t v)
  {
    const double* p = &this->Mesh.positions[3 * v];
    return std::hypot(p[0] - point[0], p[1] - point[1], p[2] - point[2]);
  };
  std::int64_t nearest = 0;
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    nearest = distance(v) < distance(nearest) ? v : nearest;
  }
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    const int expected = v == 5 || v == 2    ? 5
                         : v == nearest      ? 4
                         : this->z(v) <= 0.5 ? 3
                         : this->isMasked(v) ? 2
                         : left.contains(v)  ? 0
                                             : -1;
    EXPECT_EQ(answers.vertices.dirichlet[v], expected) << v;
    const double value[] = { this->Mesh.vertexColumns[1].value(v, 1), 2, 0,
      this->Mesh.vertexColumns[1].value(v, 1), 5, 8, 0 };
    EXPECT_EQ(answers.vertices.value[3 * v + 1], value[expected + 1]) << v;
  }
}

TEST_F(Described, TheInitialGuessIsThePositionWhereAValueIs)
{
  ProblemDescription description;
  description.columns = 3;
  description.dirichlet = { { Right, DataValue{ 1, 1, 1 } } };
  EXPECT_EQ(this->ask(description).vertices.value[0], 1.0);
  description.dirichlet.insert(description.dirichlet.begin(), { ColumnMask{ "mask" }, Position{} });
  const std::vector<double> value = this->ask(description).vertices.value;
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    EXPECT_EQ(value[3 * v + 2], this->x(v) >= 1.5 ? 1.0 : this->z(v));
  }
  description.initial = { { Bottom, DataValue{ 0, 0, 5 } } };
  description.dirichlet.clear();
  EXPECT_EQ(this->ask(description).vertices.value[2], this->z(0) <= 0.5 ? 5.0 : 0.0);
}

TEST_F(Described, TheInitialGuessIsTheMiddleOfNumbersWithAnOffset)
{
  ProblemDescription description;
  description.columns = 3;
  const auto start = [&](std::size_t column)
  { return this->ask(description).vertices.value[column]; }; // vertex 0 is not on the right
  ASSERT_LT(this->x(0), 1.5);
  description.dirichlet = { { Right, DataValue{ 293, 7, 1 } } };
  EXPECT_EQ(start(0), 293.0) << "a single number";
  description.robin = { { Bottom, 1.0, DataValue{ 303, 7, 0 } } };
  EXPECT_EQ(start(0), 298.0);
  EXPECT_EQ(start(1), 7.0) << "the same number twice";
  EXPECT_EQ(start(2), 0.0) << "as far from each other as from 0";
  description.robin.front().ambient = DataValue{ -303, -9, -0.9 };
  EXPECT_EQ(start(0), 0.0);
  description.dirichlet = { { Right, DataValue{ -293, -7, -1 } } };
  EXPECT_EQ(start(0), -298.0);
  description.initial = DataValue{ 1, 2, 3 };
  EXPECT_EQ(start(0), 1.0);
  description.initial = {};
  description.dirichlet.push_back({ Right, "three" });
  EXPECT_EQ(start(0), 0.0) << "not all are numbers";
}

TEST_F(Described, InitialValuesMayBeMissing)
{
  ProblemDescription description;
  description.initial = "nan";
  description.dirichlet = { { Everywhere{}, 1.0 } };
  EXPECT_EQ(this->ask(description).vertices.value[3], 1.0);
  // Those of a solution are, where nothing determines it.
  description.dirichlet = { { ColumnMask{ "mask" }, 1.0 } };
  for (const double value : this->ask(description).vertices.value)
  {
    EXPECT_TRUE(value == 0.0 || value == 1.0) << value;
  }
  description.dirichlet.front().value = "nan";
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "the column 'nan' must be finite at vertex",
    this->errorOf(description));
}

TEST_F(Described, SoftConstraintsAreScreeningWithATargetAndAddUp)
{
  ProblemDescription description;
  description.screening = 0.25;
  description.source = 2.0;
  description.soft = { { Right, 3.0, "one" }, { Left, "one", 4.0 },
    { Everywhere{}, { { Bottom, 8.0 } }, 1.0 } };
  const ProblemAnswers answers = this->ask(description);
  const std::set<std::int64_t> left = this->leftVertices();
  for (std::int64_t v = 0; v < this->Mesh.vertices(); ++v)
  {
    const double a = this->x(v) >= 1.5 ? 3.0 : 0.0;
    const double b = left.contains(v) ? this->one(v) : 0.0;
    const double c = this->z(v) <= 0.5 ? 8.0 : 0.0;
    EXPECT_DOUBLE_EQ(answers.vertices.screening[v], 0.25 + a + b + c);
    EXPECT_DOUBLE_EQ(answers.vertices.source[v], 2.0 + a * this->one(v) + 4.0 * b + c);
  }
}

TEST_F(Described, FluxesAndRobinConditionsOfFacets)
{
  ProblemDescription description;
  description.flux = { { Left, 1.0 }, { ColumnMask{ "mask" }, "one" }, { Right, "k" } };
  description.robin = { { Bottom, 2.0, "one" },
    { Left, { { Everywhere{}, 1.0 }, { Bottom, "one" } }, 6.0 } };
  const ProblemAnswers answers = this->ask(description);
  const auto isMasked = [&](std::int64_t v) { return this->isMasked(v); };
  const auto isRight = [&](std::int64_t v) { return this->x(v) >= 1.5; };
  const auto isBottom = [&](std::int64_t v) { return this->z(v) <= 0.5; };
  for (std::int64_t f = 0; f < 4 * this->Mesh.cells(); ++f)
  {
    const std::int64_t c = f / 4;
    const int k = static_cast<int>(f % 4);
    const int flux = this->all(c, isRight, k)    ? 2
                     : this->all(c, isMasked, k) ? 1
                     : this->isLeft(c)           ? 0
                                                 : -1;
    const bool bottom = this->all(c, isBottom, k);
    ASSERT_EQ(answers.flux[f], flux);
    ASSERT_EQ(answers.robin[f], this->isLeft(c) ? 1 : bottom ? 0 : -1);
    // The last corner of the facet.
    const std::int64_t corner = this->Mesh.corners[4 * c + (k == 3 ? 2 : 3)];
    const double values[] = { 0.0, 1.0, this->one(corner), this->Mesh.cellColumns[0].value(c) };
    EXPECT_EQ(answers.fluxValue[3 * f + 2], values[flux + 1]);
    EXPECT_EQ(answers.coefficient[3 * f + 2], this->isLeft(c) ? (bottom ? this->one(corner) : 1.0)
                                              : bottom        ? 2.0
                                                              : 0.0);
    EXPECT_EQ(answers.ambient[3 * f + 2], this->isLeft(c) ? 6.0 : bottom ? this->one(corner) : 0.0);
  }
}

TEST_F(Described, ColumnsThatItNeedsAreTold)
{
  ProblemDescription description;
  description.conductivity = { { Left, "k" } };
  description.dirichlet = { { ColumnMask{ "mask" }, "one" } };
  description.source = "one";
  const DescribedProblem problem(description, this->Source.info());
  using Names = std::vector<std::string>;
  EXPECT_EQ(problem.vertexColumns(), (Names{ "one", "mask" }));
  EXPECT_EQ(problem.cellColumns(), (Names{ "tag", "k" }));
}

TEST_F(Described, AnotherSolveOfThePreparedProblemHasTheSameBits)
{
  ProblemDescription description;
  description.conductivity = "K";
  description.dirichlet = { { Left, 1.0 }, { NearestVertices{ { { 9, 9, 9 } } }, 0.0 } };
  DescribedProblem problem(description, this->Source.info());
  problem.prepare(this->Source);
  SolveOptions options;
  options.inCore = true;
  this->Source.rewind(11);
  const Solved first = solveMesh(this->Source, problem, options);
  EXPECT_TRUE(first.report.converged);
  EXPECT_NEAR(first.values.minCoeff(), 0.0, 1e-12);
  this->Source.rewind(1000);
  options.inCore = false;
  EXPECT_TRUE(sameBits(first.values, solveMesh(this->Source, problem, options).values));
}

} // namespace smg::testing
