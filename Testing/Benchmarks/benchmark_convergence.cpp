// SPDX-License-Identifier: BSD-3-Clause
// benchmark_convergence MESH.vsm... : how fast V-cycles converge, and what holds them up.
//
//   benchmark_convergence arm.vsm --json arm-convergence.json
//
// solves (FixedEndsProblem.h) with and without acceleration, and then looks at the same hierarchy
// in core, with the kernels of a solve, without changing either. Markdown tables, of each mesh
//   by level: the factor of the V-cycle from there ("V"), and with the next level solved exactly
//     ("two-grid"): where the second is much smaller, the loss is on coarser levels; the roughness
//     of what two grids leave, see SlowestError::roughness(); and of surfaces both factors of a
//     hierarchy whose rows of P do not reproduce linear functions, see LinearRows;
//   where the slowest error sits: what share of its square the worst vertices have, and how these
//     differ from all vertices: the least angle and the greatest one at their cells, their shortest
//     edge relative to their longest one, edges, and whether they are coarse nodes;
// and at the end the V-cycles of all meshes to 1e-6, with the factor of the last one without
// acceleration, and from those tables: the two factors of the finest level, the share of its worst
// 100 vertices.

#include "Testing/Benchmarks/Output.h"
#include "Testing/Benchmarks/SlowestError.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::LevelsInCore;
using smg::benchmark::text;
using smg::testing::StreamMesh;

constexpr int Iterations = 15;
/** Factors of coarser levels have no influence. */
constexpr std::int64_t FewestNodes = 2000;

struct Options
{
  std::vector<std::string> meshes;
  std::string jsonFile;
  int plainCycles = 50;
};

using Start = smg::benchmark::FixedEndsProblem::Start;

json solved(const StreamMesh& mesh, smg::AccelerationKind acceleration, Start start, int maxCycles)
{
  smg::testing::MemorySource source(mesh);
  smg::benchmark::FixedEndsProblem problem(source.info(), start);
  smg::SolveOptions options;
  options.tolerance = 1e-6;
  options.acceleration = acceleration;
  options.maxCycles = maxCycles;
  options.memoryLimit = std::int64_t(1) << 40;
  const auto solution = smg::solve(source, problem, options);
  const smg::Report& report = solution->report();
  return { { "cycles", report.cycles }, { "converged", report.converged },
    { "residuals", report.residuals } };
}

/** What may make the error at a vertex slow. */
struct Surroundings
{
  double least = 180.0, greatest = 0.0; ///< angle, in degrees
  double shortest = std::numeric_limits<double>::max(), longest = 0.0;
  double edges = 0.0;
  bool isCoarse = false;
};

using Point = Eigen::Map<const Eigen::Vector3d>;

/** The angle at a of the triangle a, b, c, in degrees. */
double angle(const Point& a, const Point& b, const Point& c)
{
  const Eigen::Vector3d u = b - a, v = c - a;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
}

std::vector<Surroundings> surroundings(const StreamMesh& mesh)
{
  std::vector<Surroundings> all(static_cast<std::size_t>(mesh.vertices()));
  const int corners = smg::cornersOf(mesh.cellType);
  const auto at = [&](std::int64_t vertex) { return Point(mesh.positions.data() + 3 * vertex); };
  for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
  {
    const std::int64_t* v = mesh.corners.data() + cell * corners;
    double least = 180.0, greatest = 0.0;
    for (int i = 0; i < corners; ++i)
    {
      for (int j = 0; j < corners; ++j)
      {
        for (int k = j + 1; k < corners; ++k)
        {
          if (i != j && i != k)
          {
            const double a = angle(at(v[i]), at(v[j]), at(v[k]));
            least = std::min(least, a);
            greatest = std::max(greatest, a);
          }
        }
      }
    }
    for (int i = 0; i < corners; ++i)
    {
      Surroundings& s = all[static_cast<std::size_t>(v[i])];
      s.least = std::min(s.least, least);
      s.greatest = std::max(s.greatest, greatest);
      for (int j = 0; j < corners; ++j)
      {
        if (i != j)
        {
          const double edge = (at(v[j]) - at(v[i])).norm();
          s.shortest = std::min(s.shortest, edge);
          s.longest = std::max(s.longest, edge);
        }
      }
    }
  }
  return all;
}

/** Adds what the rows of the finest level say. */
void addRows(LevelsInCore& levels, std::vector<Surroundings>& all)
{
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const auto look = [&](const smg::RowBlock::Header& h, const auto& arrays, std::int64_t k)
    {
      const smg::BlockRange row = smg::entriesOf(h, arrays, k);
      const smg::BlockRange parents = smg::parentsOf(h, arrays, k);
      all[i].edges = static_cast<double>(row.end - row.begin);
      all[i].isCoarse =
        parents.end - parents.begin == 1 && arrays.parentQuanta[parents.begin] == smg::Quanta;
    };
    levels.finest().window().visitRow(static_cast<std::int64_t>(i), look);
  }
}

/** Medians, and the share of coarse nodes, of these vertices. */
json summary(const std::vector<Surroundings>& all, std::span<const std::size_t> vertices)
{
  const auto median = [&](auto&& value)
  {
    std::vector<double> values;
    for (const std::size_t i : vertices)
    {
      values.push_back(value(all[i]));
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  const auto coarse =
    std::ranges::count_if(vertices, [&](std::size_t i) { return all[i].isCoarse; });
  return { { "vertices", vertices.size() },
    { "least_angle", median([](const Surroundings& s) { return s.least; }) },
    { "greatest_angle", median([](const Surroundings& s) { return s.greatest; }) },
    { "shortest_edge", median([](const Surroundings& s) { return s.shortest / s.longest; }) },
    { "edges", median([](const Surroundings& s) { return s.edges; }) },
    { "coarse", static_cast<double>(coarse) / static_cast<double>(vertices.size()) } };
}

json whereItSits(LevelsInCore& levels, const StreamMesh& mesh, const std::vector<double>& squares)
{
  std::vector<Surroundings> all = surroundings(mesh);
  addRows(levels, all);
  std::vector<std::size_t> order(squares.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return squares[i]; });
  const double whole = std::accumulate(squares.begin(), squares.end(), 0.0);
  json rows = json::array();
  for (std::size_t count : { std::size_t(10), std::size_t(100), std::size_t(1000), order.size() })
  {
    count = std::min(count, order.size());
    double part = 0.0;
    for (std::size_t k = 0; k < count; ++k)
    {
      part += squares[order[k]];
    }
    json row = summary(all, std::span(order).first(count));
    row["share"] = whole > 0.0 ? part / whole : 0.0;
    rows.push_back(std::move(row));
  }
  return rows;
}

json levelsOf(LevelsInCore& levels, smg::benchmark::SlowestError& error)
{
  json rows = json::array();
  for (int l = levels.count() - 2; l >= 0; --l)
  {
    const smg::Report::Level& size = levels.size(l);
    if (size.nodes >= FewestNodes || l == 0)
    {
      const double twoGrid = error.factor(l, true, Iterations);
      const double roughness = error.roughness();
      json row = { { "level", l }, { "nodes", size.nodes }, { "roughness", roughness },
        { "nonzeros", static_cast<double>(size.nonzeros) / static_cast<double>(size.nodes) },
        { "two_grid", twoGrid }, { "v_cycle", error.factor(l, false, Iterations) } };
      rows.insert(rows.begin(), std::move(row));
    }
  }
  return rows;
}

json measure(const std::string& path, const Options& options)
{
  const smg::VsmReader reader(path);
  const StreamMesh mesh = smg::testing::collect(*reader.source());
  json result = { { "mesh", std::filesystem::path(path).stem().string() },
    { "vertices", mesh.vertices() },
    { "from_zero", solved(mesh, smg::AccelerationKind::Automatic, Start::Zero, 100) },
    { "from_positions", solved(mesh, smg::AccelerationKind::Automatic, Start::Positions, 100) },
    { "plain", solved(mesh, smg::AccelerationKind::None, Start::Zero, options.plainCycles) } };
  LevelsInCore levels(mesh, smg::SolveOptions().sweeps);
  smg::benchmark::SlowestError error(levels);
  result["levels"] = levelsOf(levels, error);
  LevelsInCore others(mesh, smg::SolveOptions().sweeps, false);
  smg::benchmark::SlowestError otherError(others);
  result["not_linear"] = levelsOf(others, otherError);
  // The last one was the V-cycle from the finest level.
  result["slowest"] = whereItSits(levels, mesh, error.squares());
  return result;
}

std::string cyclesOf(const json& solve)
{
  const auto cycles = std::to_string(solve["cycles"].get<int>());
  return solve["converged"].get<bool>() ? cycles : "more than " + cycles;
}

void printDetails(const json& result)
{
  std::cout
    << result["mesh"].get<std::string>() << "\n\n"
    << "| level | nodes | nonzeros a row | two-grid | roughness of its error | V | two-grid "
       "and V without linear rows |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  const json& others = result["not_linear"];
  for (const json& row : result["levels"])
  {
    const std::size_t l = row["level"];
    const std::string without = l < others.size() ? text("%.2f", others[l]["two_grid"]) + ", " +
                                                      text("%.2f", others[l]["v_cycle"])
                                                  : "-";
    std::cout << "| " << row["level"] << " | " << row["nodes"] << " | "
              << text("%.1f", row["nonzeros"]) << " | " << text("%.2f", row["two_grid"]) << " | "
              << text("%.3f", row["roughness"]) << " | " << text("%.2f", row["v_cycle"]) << " | "
              << without << " |\n";
  }
  std::cout << "\n| worst vertices | share of the slowest error | least angle | greatest angle | "
               "shortest edge | edges | coarse nodes |\n"
               "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const json& row : result["slowest"])
  {
    std::cout << "| " << row["vertices"] << " | "
              << text("%.1f %%", 100.0 * row["share"].get<double>()) << " | "
              << text("%.2f", row["least_angle"]) << " | " << text("%.1f", row["greatest_angle"])
              << " | " << text("%.3f", row["shortest_edge"]) << " | " << text("%.0f", row["edges"])
              << " | " << text("%.0f %%", 100.0 * row["coarse"].get<double>()) << " |\n";
  }
  std::cout << std::endl;
}

void printSummary(const json& results)
{
  std::cout << "| mesh | vertices | V-cycles from zero | from the positions | without acceleration "
               "| their last factor | two-grid | "
               "V | the worst 100 |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const json& result : results)
  {
    const json& plain = result["plain"]["residuals"];
    const std::size_t count = plain.size();
    const double factor =
      count > 1 ? plain[count - 1].get<double>() / plain[count - 2].get<double>() : 0.0;
    const json& finest = result["levels"][0];
    std::cout << "| " << result["mesh"].get<std::string>() << " | " << result["vertices"] << " | "
              << cyclesOf(result["from_zero"]) << " | " << cyclesOf(result["from_positions"])
              << " | " << cyclesOf(result["plain"]) << " | " << text("%.2f", factor) << " | "
              << text("%.2f", finest["two_grid"]) << " | " << text("%.2f", finest["v_cycle"])
              << " | " << text("%.0f %%", 100.0 * result["slowest"][1]["share"].get<double>())
              << " |\n";
  }
}

} // namespace

int main(int argc, char** argv)
try
{
  Options options;
  CLI::App app{ "How fast V-cycles converge, and what holds them up" };
  app.add_option("meshes", options.meshes, ".vsm files")->required()->check(CLI::ExistingFile);
  app.add_option("--plain-cycles", options.plainCycles, "most V-cycles without acceleration");
  app.add_option("--json", options.jsonFile, "where to write the numbers");
  CLI11_PARSE(app, argc, argv);
  json results = json::array();
  for (const std::string& mesh : options.meshes)
  {
    results.push_back(measure(mesh, options));
    printDetails(results.back());
  }
  printSummary(results);
  smg::benchmark::writeNumbers(options.jsonFile, results);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_convergence failed: " << error.what() << '\n';
  return 1;
}
