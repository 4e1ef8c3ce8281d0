// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Python/C/CInterface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

// Equations through the C interface: in the order of the arrays, with rows of the identity for
// vertices of no cell.

namespace smg::testing
{
namespace
{

using Numbers = std::vector<double>;
using SolverHandle = std::unique_ptr<smg_solver, decltype(&smg_close_solver)>;

SolverHandle openSolver(smg_mesh* mesh, const std::string& options)
{
  smg_solver* solver = nullptr;
  expectOk(smg_open_solver(mesh, options.c_str(), nullptr, nullptr, &solver));
  return { solver, &smg_close_solver };
}

/** A torus in a random order, and a vertex of no cell at its end. */
IndexedTestMesh solverMesh()
{
  IndexedTestMesh mesh = shuffled(torus(40, 24, 0.1));
  mesh.positions.insert(mesh.positions.end(), { 9, 9, 9 });
  return mesh;
}

constexpr const char* Held =
  R"({ "dirichlet": [ { "vertices": [3, 77], "value": 1 }, { "vertices": [500], "value": -2 } ] })";

/** The values of these conditions, and no loads. */
Numbers heldValues(const IndexedTestMesh& mesh)
{
  Numbers values(static_cast<std::size_t>(mesh.vertices()));
  values[3] = values[77] = 1.0;
  values[500] = -2.0;
  values.back() = 5.0; // of no cell
  return values;
}

double dot(const Numbers& a, const Numbers& b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

TEST(CSolver, HasTheBitsOfAJob)
{
  const IndexedTestMesh mesh = solverMesh();
  MeshHandle handle = openMesh(mesh);
  const FieldHandle field =
    run(handle.get(), "solve", std::string(R"({ "problem": )") + Held + " }");
  Numbers expected = read<double>(nullptr, field.get(), "Solution", false, 1, mesh.vertices());
  const SolverHandle solver =
    openSolver(handle.get(), std::string(R"({ "problem": )") + Held + R"(, "threads": 2 })");
  handle.reset(); // the solver keeps what it needs
  const Numbers b = heldValues(mesh);
  const smg_array right = arrayOf(b);
  for (int k = 0; k < 2; ++k)
  {
    Numbers x(b.size());
    const char* report = nullptr;
    expectOk(smg_solver_solve(solver.get(), &right, x.data(), "", nullptr, nullptr, &report));
    EXPECT_EQ(x.back(), 5.0);
    x.back() = expected.back() = 0.0; // not a number in the field
    EXPECT_EQ(x, expected);
    EXPECT_TRUE(nlohmann::json::parse(report).at("converged"));
    EXPECT_EQ(nlohmann::json::parse(report).at("seconds").at("build"), 0.0);
  }
}

TEST(CSolver, SolvesColumnsOfAnyTypeAndStride)
{
  const IndexedTestMesh mesh = solverMesh();
  const MeshHandle handle = openMesh(mesh);
  const SolverHandle solver =
    openSolver(handle.get(), std::string(R"({ "problem": )") + Held + " }");
  const auto rows = static_cast<std::size_t>(mesh.vertices());
  // Two columns, one after the other, in reverse, of integers.
  std::vector<std::int16_t> loads(2 * rows);
  Random random(1);
  std::ranges::generate(loads, [&] { return static_cast<std::int16_t>(random.uniform(-9, 9)); });
  constexpr std::int64_t Size = sizeof(std::int16_t);
  const smg_array right{ &loads.back(), SMG_INT16, mesh.vertices(), 2, -Size,
    -static_cast<std::int64_t>(rows) * Size };
  Numbers x(2 * rows), y(rows);
  expectOk(smg_solver_solve(
    solver.get(), &right, x.data(), R"({ "tolerance": 1e-12 })", nullptr, nullptr, nullptr));
  for (std::size_t column = 0; column < 2; ++column)
  {
    Numbers one(rows);
    for (std::size_t i = 0; i < rows; ++i)
    {
      one[i] = x[2 * i + column];
    }
    expectOk(smg_solver_multiply(solver.get(), one.data(), y.data()));
    for (std::size_t i = 0; i < rows; ++i)
    {
      EXPECT_NEAR(y[i], loads[2 * rows - 1 - column * rows - i], 1e-8);
    }
  }
}

TEST(CSolver, PreconditionsConjugateGradients)
{
  const IndexedTestMesh mesh = solverMesh();
  const MeshHandle handle = openMesh(mesh);
  const SolverHandle solver =
    openSolver(handle.get(), std::string(R"({ "problem": )") + Held + " }");
  const Numbers b = heldValues(mesh);
  Numbers x = b, r(b.size()), z(b.size()), image(b.size()); // x = b at fixed vertices
  expectOk(smg_solver_multiply(solver.get(), x.data(), r.data()));
  std::ranges::transform(b, r, r.begin(), std::minus());
  const double first = std::sqrt(dot(r, r));
  expectOk(smg_solver_precondition(solver.get(), r.data(), z.data()));
  Numbers p = z;
  double rz = dot(r, z);
  int steps = 0;
  for (; steps < 50 && std::sqrt(dot(r, r)) > 1e-10 * first; ++steps)
  {
    expectOk(smg_solver_multiply(solver.get(), p.data(), image.data()));
    const double length = rz / dot(p, image);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x[i] += length * p[i];
      r[i] -= length * image[i];
    }
    z = r;
    expectOk(smg_solver_precondition(solver.get(), z.data(), z.data()));
    const double next = dot(r, z);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      p[i] = z[i] + next / rz * p[i];
    }
    rz = next;
  }
  EXPECT_LE(steps, 15);
  Numbers expected(b.size());
  const smg_array right = arrayOf(b);
  expectOk(smg_solver_solve(
    solver.get(), &right, expected.data(), R"({ "tolerance": 1e-12 })", nullptr, nullptr, nullptr));
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_NEAR(x[i], expected[i], 1e-8);
  }
}

TEST(CSolver, SaysWhatIsWrong)
{
  const IndexedTestMesh mesh = solverMesh();
  const MeshHandle handle = openMesh(mesh);
  const auto expectFailure = [](smg_status status, smg_status expected, const std::string& sentence)
  {
    EXPECT_EQ(status, expected);
    EXPECT_NE(std::string(smg_error()).find(sentence), std::string::npos) << smg_error();
  };
  smg_solver* none = nullptr;
  const auto open = [&](const char* options)
  { return smg_open_solver(handle.get(), options, nullptr, nullptr, &none); };
  expectFailure(open("{"), SMG_INVALID, "options");
  expectFailure(open(R"({ "tolerance": 1 })"), SMG_INVALID, "tolerance");
  expectFailure(open(R"({ "sweeps": 0 })"), SMG_INVALID, "sweeps");
  expectFailure(open(R"({ "problem": { "screening": "nothing" } })"), SMG_FAILED, "nothing");
  const smg_progress cancels = [](double, void*) { return 1; };
  expectFailure(smg_open_solver(handle.get(), "", cancels, nullptr, &none), SMG_CANCELLED, "");
  EXPECT_EQ(none, nullptr);
  expectFailure(smg_open_solver(nullptr, "", nullptr, nullptr, &none), SMG_INVALID, "mesh");

  const SolverHandle solver = openSolver(handle.get(), "");
  Numbers b(static_cast<std::size_t>(mesh.vertices()), 1.0), x(b.size());
  const auto solve = [&](const smg_array& right, const char* options, smg_progress progress)
  { return smg_solver_solve(solver.get(), &right, x.data(), options, progress, nullptr, nullptr); };
  smg_array right = arrayOf(b);
  expectFailure(solve(right, R"({ "tolerance": 0 })", nullptr), SMG_INVALID, "options: tolerance");
  expectFailure(solve(right, "", cancels), SMG_CANCELLED, "");
  right.rows -= 1;
  expectFailure(solve(right, "", nullptr), SMG_INVALID, "b: must have a row for each of the");
  b[7] = std::numeric_limits<double>::infinity();
  expectFailure(solve(arrayOf(b), "", nullptr), SMG_INVALID, "b: row 7 has a number");
  EXPECT_EQ(x, Numbers(b.size())) << "unchanged";
  expectFailure(smg_solver_multiply(solver.get(), nullptr, x.data()), SMG_INVALID, "NULL");
  // And goes on: a component without any condition.
  b[7] = 1.0;
  expectOk(solve(arrayOf(b), "", nullptr));
}

TEST(CSolver, NamesTheMemoryThatItNeeds)
{
  const MeshHandle handle = openMesh(torus(200, 100));
  smg_solver* none = nullptr;
  EXPECT_EQ(
    smg_open_solver(handle.get(), R"({ "memory": "1MiB" })", nullptr, nullptr, &none), SMG_MEMORY);
  EXPECT_NE(std::string(smg_error()).find("but the limit is 1 MiB"), std::string::npos)
    << smg_error();
}

} // namespace smg::testing
