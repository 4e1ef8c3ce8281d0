// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Mesh/AddedColumn.h"
#include "smg/DescribedProblem.h"
#include "smg/Solve.h"

#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/ErrorMessage.h"

#include <gtest/gtest.h>

namespace smg::testing
{
namespace
{

class DescribedErrors : public ::testing::Test
{
protected:
  std::string errorOf(const ProblemDescription& description)
  {
    return messageOf(
      [&]
      {
        this->Source.rewind(7);
        DescribedProblem problem(description, this->Source.info(), "p.json");
        problem.prepare(this->Source);
        this->Source.rewind(7);
        answersOf(problem, this->Source);
      });
  }
  std::string errorOfConductivity(const Datum& conductivity)
  {
    ProblemDescription description;
    description.conductivity = conductivity;
    return this->errorOf(description);
  }
  std::string errorOfDirichlet(const Where& where, const DataValue& value = 0.0)
  {
    ProblemDescription description;
    description.dirichlet = { { Everywhere{}, 0.0 }, { where, value } };
    return this->errorOf(description);
  }

  MemorySource Source{ describedMesh() };
};

#define EXPECT_SAYS(text, part) EXPECT_PRED_FORMAT2(::testing::IsSubstring, part, text)

} // namespace

TEST_F(DescribedErrors, ColumnsThatDoNotExistAndThoseThatDo)
{
  const std::string error = this->errorOfConductivity("c");
  EXPECT_SAYS(error, "p.json: conductivity: the mesh has no column 'c'");
  EXPECT_SAYS(error, "its vertices have 'one', 'three' (3), 'mask'");
  EXPECT_SAYS(error, "its cells 'k', 'diagonal' (3), 'K' (6), 'q' (3), 'tag', 'cellMask'");
  EXPECT_SAYS(this->errorOfConductivity({ { Everywhere{}, 1.0 }, { ColumnTag{ "t", 1 }, 2.0 } }),
    "p.json: conductivity[1].tag: the mesh has no column 't'");
  EXPECT_SAYS(this->errorOfDirichlet(ColumnMask{ "three" }),
    "dirichlet[1].mask: the column 'three' has 3 components, but must have one");
  EXPECT_SAYS(this->errorOfDirichlet(ColumnMask{ "mask" }, "three"),
    "dirichlet[1].value: the components of the column 'three' are 3, but must have 1");
  EXPECT_SAYS(this->errorOfDirichlet(ColumnMask{ "mask" }, "k"),
    "dirichlet[1].value: 'k' is a column of the cells");
}

TEST_F(DescribedErrors, ValuesOutOfRange)
{
  for (const Datum& bad : { Datum(0.0), Datum(-2.0), Datum(NAN), Datum(DataValue{ 1, 1, -1 }),
         Datum(DataValue{ 1, 1, 1, 2, 0, 0 }) })
  {
    EXPECT_SAYS(this->errorOfConductivity(bad), "p.json: conductivity: must be a positive number");
  }
  EXPECT_SAYS(this->errorOfConductivity(DataValue{ 1, 2 }), "1, 3 or 6");
  EXPECT_SAYS(this->errorOfConductivity(Position{}), "conductivity: can be \"position\" only");
  EXPECT_SAYS(this->errorOfDirichlet(Everywhere{}, Position{}), "only where there are 3 columns");

  ProblemDescription description;
  description.screening = -1.0;
  EXPECT_SAYS(this->errorOf(description), "screening: must be finite and not negative");
  description.screening = 1e308;
  EXPECT_SAYS(this->errorOf(description), "p.json: screening: must not be above 1e150");
  EXPECT_SAYS(
    this->errorOfDirichlet(Everywhere{}, -1e200), "dirichlet[1].value: must not be above");
  description = {};
  description.robin = { { Everywhere{}, -1.0, 0.0 } };
  EXPECT_SAYS(this->errorOf(description), "robin[0].coefficient: must be finite and not negative");
  description = {};
  description.soft = { { Everywhere{}, 1.0, "nan" } };
  EXPECT_SAYS(this->errorOf(description),
    "soft[0].value: the column 'nan' must be finite at vertex 0 of the stream");
  description = {};
  description.columns = 65;
  EXPECT_SAYS(this->errorOf(description), "columns: must be from 1 to 64");
  description = {};
  description.weights = Weights::Uniform;
  description.conductivity = 2.0;
  EXPECT_SAYS(this->errorOf(description), "conductivity: goes with cotangent and clamped weights");
}

TEST_F(DescribedErrors, ValuesOfColumnsAreNamedByTheNumbersOfTheFile)
{
  StreamMesh mesh = describedMesh();
  std::vector<std::int64_t> cells, vertices;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    cells.push_back(1000 + c);
  }
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    vertices.push_back(500 + v);
  }
  mesh.cellColumns.push_back(makeColumn<std::int64_t>(OriginalCellIdName, cells));
  mesh.vertexColumns.push_back(makeColumn<std::int64_t>(OriginalIdName, vertices));
  // The tensor of cell 20 gets a negative eigenvalue, the coefficient of vertex 7 a sign.
  mesh.cellColumns[2].as<double>()[6 * 20 + 3] = 40.0;
  mesh.vertexColumns[0].as<double>()[7] = -1.0;
  this->Source = MemorySource(mesh);
  EXPECT_SAYS(this->errorOfConductivity("K"),
    "conductivity: the column 'K' must be a positive number or a positive "
    "definite tensor in cell 1020 of the original mesh");
  ProblemDescription description;
  description.screening = "one";
  EXPECT_SAYS(this->errorOf(description), "screening: the column 'one' must be finite and not "
                                          "negative at vertex 507 of the original mesh");

  mesh.vertexColumns[0].as<double>()[7] = NAN;
  mesh.cellColumns[0].as<double>()[3] = NAN;
  this->Source = MemorySource(mesh);
  EXPECT_SAYS(this->errorOfDirichlet(ColumnMask{ "one" }),
    "dirichlet[1].mask: is not a number at vertex 507 of the original mesh");
  EXPECT_SAYS(this->errorOfConductivity({ { ColumnMask{ "k" }, 2.0 } }),
    "conductivity[0].mask: is not a number in cell 1003 of the original mesh");
}

TEST_F(DescribedErrors, ValuesOfTheBoundaryAreNamedByTheNumbersOfTheFile)
{
  StreamMesh mesh = describedMesh();
  std::vector<std::int64_t> cells;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    cells.push_back(1000 + c);
    mesh.cellColumns[0].as<double>()[c] = NAN;
  }
  mesh.cellColumns.push_back(makeColumn<std::int64_t>(OriginalCellIdName, cells));
  ProblemDescription description;
  description.flux = { { Everywhere{}, "k" } };
  MemorySource source(mesh);
  DescribedProblem problem(description, source.info(), "p.json");
  problem.prepare(source);
  source.rewind(7);
  const std::string error = messageOf([&] { solve(source, problem, {}); });
  EXPECT_SAYS(error, "flux[0]: is not a finite number on the boundary of cell 10");
  EXPECT_SAYS(error, "of the original mesh");
}

TEST_F(DescribedErrors, PlacesThatSelectNothing)
{
  EXPECT_SAYS(this->errorOfDirichlet(Region::Sphere{ { 50, 0, 0 }, 1 }),
    "dirichlet[1]: no vertex of the mesh is in this region");
  EXPECT_SAYS(this->errorOfDirichlet(ColumnTag{ "mask", 2 }),
    "no vertex of the mesh has this tag in 'mask': its values are 0 and 1");
  EXPECT_SAYS(this->errorOfDirichlet(ColumnTag{ "tag", 2 }),
    "dirichlet[1]: no vertex of the mesh is of a cell that has this tag in 'tag': its values are");
  EXPECT_SAYS(this->errorOfDirichlet(Region::Vertices{ { 3, 99 } }),
    "dirichlet[1].vertices: the mesh has no vertex with the original number 99");
  EXPECT_SAYS(
    this->errorOfDirichlet(NearestVertices{}), "dirichlet[1].nearest: must have at least");
  EXPECT_SAYS(this->errorOfDirichlet(Region::Sphere{ {}, -1 }),
    "dirichlet[1]: the region must have a radius");
  // A cell is in a region if all its corners are.
  EXPECT_SAYS(
    this->errorOfConductivity({ { Region::Sphere{ {}, 0.2 }, 2.0 } }), "conductivity[0]: no cell");
  ProblemDescription description;
  description.flux = { { Region::Sphere{ {}, 0.2 }, 2.0 } };
  EXPECT_SAYS(this->errorOf(description), "flux[0]: no face of the mesh is in this region");
}

TEST_F(DescribedErrors, WhatIsKnownOnlyAfterReadingMustBePrepared)
{
  ProblemDescription description;
  for (const Where& where : { Where(ColumnTag{ "tag", 3 }), Where(NearestVertices{ { {} } }) })
  {
    description.dirichlet = { { where, 1.0 } };
    DescribedProblem problem(description, this->Source.info());
    this->Source.rewind(100);
    EXPECT_SAYS(
      messageOf([&] { answersOf(problem, this->Source); }), "call DescribedProblem::prepare()");
  }
  description.dirichlet = { { ColumnMask{ "mask" }, 1.0 } };
  DescribedProblem problem(description, this->Source.info());
  this->Source.rewind(100);
  EXPECT_EQ(messageOf([&] { answersOf(problem, this->Source); }), "");
}

} // namespace smg::testing
