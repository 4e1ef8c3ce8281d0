// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/ParseDescriptions.h"
#include "IO/Files/PartialProgress.h"
#include "Python/C/Call.h"
#include "Python/C/Handles.h"
#include "Python/C/Options.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "smg/LinearSolver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/** Equations with their hierarchy, in memory or on disk, and the rows of the vertices in the order
 * of the caller. Nothing of the mesh is needed any more. */
struct smg_solver
{
  std::variant<smg::LinearSolver, smg::SystemOnDisk> solver;
  /** The row of each vertex of the stream; empty: its index. */
  std::vector<std::int64_t> rows;
  std::int64_t count; ///< of rows
  /** The rows of no vertex, which are rows of the identity. */
  std::vector<std::int64_t> others;
  std::string text; ///< the one last returned

  std::int64_t vertices() const
  {
    return std::visit([](const auto& of) { return of.vertices(); }, this->solver);
  }
  std::int64_t row(std::int64_t vertex) const
  {
    return this->rows.empty() ? vertex : this->rows[static_cast<std::size_t>(vertex)];
  }
};

namespace smg
{
namespace
{

/** The rows of the vertices of a stream; empty: they are in order. */
std::vector<std::int64_t> rowsOf(
  const StoredMesh& mesh, const OriginalRows& places, const ProgressFunction& progress)
{
  if (places.column.empty())
  {
    return places.table;
  }
  std::vector<std::int64_t> rows;
  visitBlocks(*mesh.source(places.columns(), {}), progress, 0.0, 1.0,
    [&](const MeshBlock& block) { places.append(block, rows); });
  return rows;
}

/** The other rows of `count`. */
std::vector<std::int64_t> othersOf(const std::vector<std::int64_t>& rows, std::int64_t count)
{
  std::vector<std::int64_t> others;
  if (!rows.empty() && static_cast<std::int64_t>(rows.size()) < count)
  {
    std::vector<bool> isVertex(static_cast<std::size_t>(count));
    for (const std::int64_t row : rows)
    {
      isVertex[static_cast<std::size_t>(row)] = true;
    }
    for (std::int64_t row = 0; row < count; ++row)
    {
      if (!isVertex[static_cast<std::size_t>(row)])
      {
        others.push_back(row);
      }
    }
  }
  return others;
}

/** What smg_open_solver() is asked for. */
struct Equations
{
  ProblemDescription problem;
  SolveOptions options;
  bool onDisk = false;
};

Equations equationsIn(const char* text, const JobLimits& defaults)
{
  const nlohmann::json json = optionsText(text, "options");
  return argument(
    [&]
    {
      const JsonNode node(json, "options");
      node.requireObject({ "problem", "sweeps", "memory", "threads", "on_disk" });
      Equations equations;
      SolveOptions& options = equations.options;
      const JobLimits limits = limitsIn(node, defaults);
      options.memoryLimit = limits.memory > 0 ? limits.memory : options.memoryLimit;
      options.threads = limits.threads;
      options.scratch = limits.scratch;
      equations.onDisk = node.has("on_disk") && flagIn(node.member("on_disk"));
      if (node.has("problem"))
      {
        equations.problem = parseProblem(node.member("problem"));
      }
      if (node.has("sweeps"))
      {
        options.sweeps = static_cast<int>(node.member("sweeps").integer(1, 20));
      }
      return equations;
    });
}

/** When smg_solver_solve() ends. */
struct Ending
{
  double tolerance = 1e-8;
  int maxCycles = 50;
};

Ending endingIn(const char* text)
{
  const nlohmann::json json = optionsText(text, "options");
  return argument(
    [&]
    {
      const JsonNode node(json, "options");
      node.requireObject({ "tolerance", "max_cycles" });
      Ending ending;
      if (node.has("tolerance"))
      {
        ending.tolerance = numberIn(node.member("tolerance"), { 0.0, 1.0, true });
      }
      if (node.has("max_cycles"))
      {
        ending.maxCycles = static_cast<int>(node.member("max_cycles").integer(1, 1000000));
      }
      return ending;
    });
}

/** The rows of an array that are those of vertices, in stream order. Throws ArgumentError if a
 * number is not finite. */
std::vector<double> ofVertices(const smg_solver& solver, const ArrayView& array, const char* name)
{
  std::vector<double> values;
  const std::int64_t vertices = solver.vertices();
  values.reserve(static_cast<std::size_t>(vertices * array.columns));
  for (std::int64_t vertex = 0; vertex < vertices; ++vertex)
  {
    const std::int64_t row = solver.row(vertex);
    for (std::int64_t k = 0; k < array.columns; ++k)
    {
      values.push_back(array.value<double>(row, k));
      if (!std::isfinite(values.back()))
      {
        throw ArgumentError(
          std::string(name) + ": row " + std::to_string(row) + " has a number that is not finite.");
      }
    }
  }
  return values;
}

/** A C-contiguous array of the rows of a solver. */
ArrayView denseArray(const smg_solver& solver, const double* values, std::int64_t columns)
{
  constexpr auto Size = static_cast<std::int64_t>(sizeof(double));
  return { values, ScalarType::Float64, solver.count, columns, columns * Size, Size };
}

/** Writes the rows of vertices, given in stream order, to an array that has its other rows. */
void storeRows(
  const smg_solver& solver, const std::vector<double>& values, std::int64_t columns, double* array)
{
  for (std::int64_t vertex = 0; vertex < solver.vertices(); ++vertex)
  {
    std::copy_n(values.data() + vertex * columns, columns, array + solver.row(vertex) * columns);
  }
}

/** The numbers of the vertices of a block in an array of this many columns: calls f(place in the
 * block, row, column). */
template <class F>
void forNumbers(const smg_solver& solver, const VectorBlock& block, F&& f)
{
  std::size_t place = 0;
  for (std::int64_t vertex = block.first; vertex < block.first + block.count; ++vertex)
  {
    for (std::int64_t k = block.column; k < block.column + block.columns; ++k)
    {
      f(place++, solver.row(vertex), k);
    }
  }
}

/** Solves for the columns of an array; `x` has the initial values and gets the solution. */
const Report& solved(const smg_solver& solver, LinearSolver& in, const ArrayView& b, double* x,
  const Ending& ending, const ProgressFunction& progress)
{
  const std::vector<double> load = ofVertices(solver, b, "b");
  std::vector<double> values = ofVertices(solver, denseArray(solver, x, b.columns), "x");
  const Report& report = in.solve(load, values, ending.tolerance, ending.maxCycles, progress);
  storeRows(solver, values, b.columns, x);
  return report;
}

/** The same without copies of the arrays, which may be larger than the memory, in files. */
const Report& solved(const smg_solver& solver, SystemOnDisk& on, const ArrayView& b, double* x,
  const Ending& ending, const ProgressFunction& progress)
{
  const auto give = [&](
                      const VectorBlock& block, std::span<double> right, std::span<double> initial)
  {
    forNumbers(solver, block,
      [&](std::size_t place, std::int64_t row, std::int64_t k)
      {
        right[place] = b.value<double>(row, k);
        initial[place] = x[row * b.columns + k];
        if (!std::isfinite(right[place]) || !std::isfinite(initial[place]))
        {
          throw ArgumentError(std::string(std::isfinite(right[place]) ? "x" : "b") + ": row " +
                              std::to_string(row) + " has a number that is not finite.");
        }
      });
  };
  const auto take = [&](const VectorBlock& block, std::span<const double> solution)
  {
    forNumbers(solver, block,
      [&](std::size_t place, std::int64_t row, std::int64_t k)
      { x[row * b.columns + k] = solution[place]; });
  };
  return on.solve(b.columns, give, take, ending.tolerance, ending.maxCycles, progress);
}

/** Applies one of the operators of a solver to a vector; rows of no vertex are those of the
 * identity. */
template <class Operator>
smg_status applied(smg_solver* solver, const double* from, double* to, const Operator& apply)
{
  return guarded(
    [&]
    {
      smg_solver& given = required(solver, "solver");
      const ArrayView array = denseArray(given, &required(from, "the given vector"), 1);
      double* const result = &required(to, "the vector for the result");
      auto* const inMemory = std::get_if<LinearSolver>(&given.solver);
      if (!inMemory)
      {
        throw ArgumentError("solver: its hierarchy is on disk, so that it solves but neither "
                            "multiplies nor preconditions: make it without on_disk.");
      }
      std::vector<double> values = ofVertices(given, array, "the given vector");
      apply(*inMemory, values);
      if (from != to)
      {
        std::copy_n(from, given.count, result);
      }
      storeRows(given, values, 1, result);
    });
}

} // namespace
} // namespace smg

smg_status smg_open_solver(
  smg_mesh* mesh, const char* options, smg_progress progress, void* user, smg_solver** solver)
{
  return smg::guarded(
    [&]
    {
      smg::required(solver, "solver") = nullptr;
      const smg_mesh& given = smg::required(mesh, "mesh");
      smg::Equations asked = smg::equationsIn(options, smg::limitsOf(given.shared->options()));
      const smg::ProgressFunction reported = smg::progressOf(progress, user);
      const auto order = given.shared->order(smg::partOf(reported, 0.0, 0.05));
      given.shared->requireRows(smg::optionsText(options, "options"), {});
      std::vector<std::int64_t> rows =
        smg::rowsOf(given.stored(), order->vertices(), smg::partOf(reported, 0.05, 0.1));
      asked.options.progress = smg::partOf(reported, 0.1, 1.0);
      const auto opened = [&]() -> decltype(smg_solver::solver)
      {
        if (asked.onDisk)
        {
          return smg::SystemOnDisk(given.stored(), asked.problem, asked.options);
        }
        return smg::LinearSolver(given.stored(), asked.problem, asked.options);
      };
      const std::int64_t count = order->vertices().count;
      std::vector<std::int64_t> others = smg::othersOf(rows, count);
      *solver = new smg_solver{ opened(), std::move(rows), count, std::move(others), {} };
    });
}

smg_status smg_solver_solve(smg_solver* solver, const smg_array* b, double* x, const char* options,
  smg_progress progress, void* user, const char** report)
{
  return smg::guarded(
    [&]
    {
      smg_solver& given = smg::required(solver, "solver");
      const smg::ArrayView right = smg::viewOf(b, "b");
      double* const result = &smg::required(x, "x");
      const smg::Ending ending = smg::endingIn(options);
      if (right.rows != given.count)
      {
        throw smg::ArgumentError("b: must have a row for each of the " +
                                 std::to_string(given.count) + " vertices, not " +
                                 std::to_string(right.rows) + ".");
      }
      const smg::Report& done = std::visit([&](auto& of) -> const smg::Report&
        { return smg::solved(given, of, right, result, ending, smg::progressOf(progress, user)); },
        given.solver);
      for (const std::int64_t row : given.others)
      {
        for (std::int64_t k = 0; k < right.columns; ++k)
        {
          result[row * right.columns + k] = right.value<double>(row, k);
        }
      }
      if (report)
      {
        given.text = done.json();
        *report = given.text.c_str();
      }
    });
}

smg_status smg_solver_precondition(smg_solver* solver, const double* r, double* z)
{
  return smg::applied(solver, r, z,
    [](smg::LinearSolver& of, std::vector<double>& values) { of.precondition(values, values); });
}

smg_status smg_solver_multiply(smg_solver* solver, const double* x, double* y)
{
  return smg::applied(solver, x, y,
    [](smg::LinearSolver& of, std::vector<double>& values) { of.multiply(values, values); });
}

void smg_close_solver(smg_solver* solver)
{
  delete solver;
}
