// SPDX-License-Identifier: BSD-3-Clause
// A step of smoothing and a blend are elliptic problems: they are written as such for the oracle of
// solves.
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Random/Evaluation.h"
#include "Testing/Random/JobRuns.h"
#include "Testing/Support/MemoryMesh.h"
#include "smg/Blend.h"
#include "smg/DescriptionFiles.h"
#include "smg/Smooth.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using nlohmann::json;

std::vector<double> listOf(const MatrixXd& rows)
{
  std::vector<double> values;
  for (Eigen::Index v = 0; v < rows.rows(); ++v)
  {
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
    {
      values.push_back(rows(v, k));
    }
  }
  return values;
}

/** A case of the elliptic problem -div(grad u - q) + s u = f for the oracle. */
Case asSolve(const Case& given, const MatrixXd& values, const json& hold)
{
  Case solve = given;
  solve.job = "solve";
  solve.vertexColumns.push_back(
    { "#values", static_cast<int>(values.cols()), listOf(values), false });
  solve.problem = { { "columns", values.cols() }, { "initial", "#values" } };
  for (json place : hold)
  {
    place["value"] = "#values";
    solve.problem["dirichlet"].push_back(place);
  }
  return solve;
}

/** The measures of the cells of a moved mesh, lumped; cells that had none still have none. */
VectorXd massOf(const Case& given, const MatrixXd& points)
{
  const std::vector<std::uint8_t> flags = given.flags();
  const int size = cornersOf(given.type);
  VectorXd mass = VectorXd::Zero(given.vertices());
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    const std::int64_t* corner = given.cell(c);
    const auto edge = [&](int k) -> Vector3d
    { return points.row(corner[k]) - points.row(corner[0]); };
    const double measure = flags[static_cast<std::size_t>(c)] != 0 ? 0.0
                           : size == 3 ? edge(1).cross(edge(2)).norm() / 2
                                       : std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6;
    for (int k = 0; k < size; ++k)
    {
      mass[corner[k]] += measure / size;
    }
  }
  return mass;
}

} // namespace

void checkSmoothing(const Case& given, CheckedCase& to)
{
  const json& asked = given.problem;
  const std::string column = asked.at("column");
  const std::string boundary = asked.at("boundary");
  const double size = asked.at("size");
  const int steps = asked.at("steps");
  const TemporaryFolder folder;
  const Result found = sameAsPlain(
    given,
    [&](const CaseRun& run)
    {
      const MemoryMesh mesh(given.stream(), run.blockCells);
      auto options = optionsOf<Smoothing>(run, folder);
      options.size = { size, SmoothingSize::Mesh };
      options.steps = steps;
      options.hold = asked.at("hold").empty() ? std::vector<Where>{}
                                              : readPlacesText(asked.at("hold").dump(), "hold");
      options.boundary = boundary == "smooth"  ? SmoothedBoundary::Smooth
                         : boundary == "fixed" ? SmoothedBoundary::Fixed
                                               : SmoothedBoundary::Free;
      options.keepVolume = asked.at("keepVolume");
      options.column = column;
      const std::unique_ptr<Solution> solution = smooth(mesh, options, options);
      return Result{ valuesOf(*solution), solution->report() };
    },
    to);
  if (!to.failure.empty() || asked.at("keepVolume") || boundary == "smooth")
  {
    return;
  }
  json hold = asked.at("hold");
  if (boundary == "fixed")
  {
    hold.push_back({ { "boundary", true } });
  }
  const CaseColumn* values = column.empty() ? nullptr : find(given.vertexColumns, column);
  MatrixXd x = values ? rowsOf(values->values, values->components) : rowsOf(given.points, 3);
  const VectorXd rest = massOf(given, rowsOf(given.points, 3));
  const double t = (std::exp2(1.0 / steps) - 1.0) * std::pow(size / (2.0 * std::numbers::pi), 2);
  for (int step = 0; step < steps; ++step)
  {
    // L u + (M / t) u = (M / t) x, with M in units of that of the mesh.
    const VectorXd mass = values ? rest : massOf(given, x);
    const VectorXd reaction = (rest.array() > 0.0).select(mass.array() / rest.array() / t, 0.0);
    Case solve = asSolve(given, x, hold);
    solve.vertexColumns.push_back({ "#reaction", 1, listOf(reaction), false });
    solve.vertexColumns.push_back(
      { "#source", static_cast<int>(x.cols()), listOf(reaction.asDiagonal() * x), false });
    solve.problem["screening"] = "#reaction";
    solve.problem["source"] = "#source";
    const Oracle oracle(solve);
    if (step + 1 == steps)
    {
      compare(solve, oracle, found.values, found.report, to);
    }
    for (Eigen::Index v = 0; v < x.rows(); ++v)
    {
      if (oracle.determined[static_cast<std::size_t>(v)])
      {
        x.row(v) = oracle.solution.row(v);
      }
    }
  }
}

namespace
{

/** The patch of each vertex; none: it has several. */
std::vector<std::optional<double>> patchesOf(const Case& given)
{
  const std::string name = given.problem.at("patch");
  std::vector<std::optional<double>> patches(static_cast<std::size_t>(given.vertices()));
  if (const CaseColumn* column = find(given.vertexColumns, name))
  {
    std::ranges::copy(column->values, patches.begin());
    return patches;
  }
  const CaseColumn& column = *find(given.cellColumns, name);
  std::vector<std::set<double>> of(patches.size());
  for (std::size_t k = 0; k < given.corners.size(); ++k)
  {
    of[static_cast<std::size_t>(given.corners[k])].insert(
      column.values[k / static_cast<std::size_t>(cornersOf(given.type))]);
  }
  for (std::size_t v = 0; v < of.size(); ++v)
  {
    if (of[v].size() == 1)
    {
      patches[v] = *of[v].begin();
    }
  }
  return patches;
}

/** The gradients that a blend aims at: of each cell, three numbers a component. */
std::vector<double> gradientsAimedAt(
  const Case& given, const Shapes& shapes, const MatrixXd& values)
{
  const std::vector<std::optional<double>> patches = patchesOf(given);
  const int size = cornersOf(given.type);
  const auto components = values.cols();
  const bool isAverage = given.problem.at("seam") == "average";
  const auto isInside = [&](std::int64_t c)
  {
    const auto& first = patches[static_cast<std::size_t>(given.cell(c)[0])];
    return first &&
           std::all_of(given.cell(c), given.cell(c) + size,
             [&](std::int64_t v) { return patches[static_cast<std::size_t>(v)] == first; });
  };
  const auto gradientOf = [&](std::int64_t c)
  {
    const MatrixXd& shape = shapes.gradients[static_cast<std::size_t>(c)];
    MatrixXd gradient = MatrixXd::Zero(3, components);
    for (int k = 0; k < shape.rows(); ++k)
    {
      gradient += shape.row(k).transpose() * values.row(given.cell(c)[k]);
    }
    return gradient;
  };
  std::vector<std::pair<double, MatrixXd>> around(
    static_cast<std::size_t>(given.vertices()), { 0.0, MatrixXd::Zero(3, components) });
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    if (!isInside(c) || shapes.gradients[static_cast<std::size_t>(c)].size() == 0)
    {
      continue;
    }
    const double measure = shapes.measure[c];
    for (int k = 0; k < size; ++k)
    {
      auto& [sum, gradients] = around[static_cast<std::size_t>(given.cell(c)[k])];
      sum += measure;
      gradients += measure * gradientOf(c);
    }
  }
  std::vector<double> aims;
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    MatrixXd aim = MatrixXd::Zero(3, components);
    if (isInside(c))
    {
      aim = gradientOf(c);
    }
    else if (isAverage)
    {
      double sum = 0.0;
      for (int k = 0; k < size; ++k)
      {
        const auto& [measure, gradients] = around[static_cast<std::size_t>(given.cell(c)[k])];
        sum += measure;
        aim += gradients;
      }
      aim /= sum > 0.0 ? sum : 1.0;
    }
    aims.insert(aims.end(), aim.data(), aim.data() + aim.size());
  }
  return aims;
}

} // namespace

void checkBlend(const Case& given, CheckedCase& to)
{
  const json& asked = given.problem;
  BlendDescription description;
  description.patch = asked.at("patch");
  description.columns = asked.at("columns").get<std::vector<std::string>>();
  description.anchor = asked.at("anchor");
  description.seam = asked.at("seam") == "average" ? SeamGradient::Average : SeamGradient::Zero;
  if (!asked.at("hold").empty())
  {
    description.hold = readPlacesText(asked.at("hold").dump(), "hold");
  }
  const TemporaryFolder folder;
  const Result found = sameAsPlain(
    given,
    [&](const CaseRun& run)
    {
      const MemoryMesh mesh(given.stream(), run.blockCells);
      const std::unique_ptr<Solution> solution =
        blend(mesh, description, optionsOf<SolveOptions>(run, folder));
      return Result{ valuesOf(*solution), solution->report() };
    },
    to);
  if (!to.failure.empty())
  {
    return;
  }
  const CaseColumn& column = *find(given.vertexColumns, description.columns.at(0));
  const MatrixXd values = rowsOf(column.values, column.components);
  Case solve = asSolve(given, values, asked.at("hold"));
  const MatrixXd points = rowsOf(given.points, 3);
  const double screening =
    description.anchor / (points.colwise().maxCoeff() - points.colwise().minCoeff()).squaredNorm();
  solve.problem["screening"] = screening;
  solve.vertexColumns.push_back(
    { "#source", column.components, listOf(screening * values), false });
  solve.problem["source"] = "#source";
  solve.cellColumns.push_back(
    { "#aim", 3 * column.components, gradientsAimedAt(given, Shapes(given), values), false });
  solve.problem["field"] = "#aim";
  compare(solve, Oracle(solve), found.values, found.report, to);
}

} // namespace smg::testing
