// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Testing/Solver/EllipticTesting.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The shapes of good and bad conductors of the laws of high contrasts, and their results.

namespace smg::testing
{

struct Shape
{
  std::string name;
  /** Sets the part of each point, 0 or 1, and the conditions, for a mesh of this size. */
  std::function<void(ElementProblem&, const Point& size)> set;
};

inline void hold(ElementProblem& problem, ElementProblem::Where where, double value)
{
  problem.DirichletConditions.push_back(
    { std::move(where), [value](const Point&) { return Eigen::VectorXd::Constant(1, value); } });
}

/** The part is 0 in the lower half, along x, and 1 in the upper one. */
inline void halve(ElementProblem& problem, const Point& size)
{
  problem.Part = [size](const Point& x) { return x[0] < 0.5 * size[0] ? 0 : 1; };
}

/** What flows differs little from rounding, which must not push the good conductor as a whole up or
 * down. */
inline std::vector<Shape> looselyHeldShapes()
{
  return {
    { "good conductor held by a bad one",
      [](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 20.0);
        p.RobinConditions.push_back({ above(0, size[0] - 0.5), [](const Point&) { return 0.1; },
          [](const Point&) { return Eigen::VectorXd::Constant(1, 23.0); } });
      } },
    { "good conductor in a bad one",
      [](ElementProblem& p, const Point& size)
      {
        p.Part = [size](const Point& x)
        { return (x - 0.5 * size).norm() < 0.25 * size.norm() ? 1 : 0; };
        for (const bool isFirst : { true, false })
        {
          p.RobinConditions.push_back({ isFirst ? below(0, 0.5) : above(0, size[0] - 0.5),
            [](const Point&) { return 0.1; },
            [isFirst](const Point&) { return Eigen::VectorXd::Constant(1, isFirst ? 0 : 100); } });
        }
      } },
  };
}

inline std::vector<Shape> shapes()
{
  const auto ends = [](ElementProblem& p, const Point& size)
  {
    hold(p, below(0, 0.5), 0.0);
    hold(p, above(0, size[0] - 0.5), 1.0);
  };
  return {
    { "layers",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        ends(p, size);
      } },
    { "electrode in the good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 0.0);
        hold(
          p, [size](const Point& x) { return (x - 0.75 * size).norm() < 0.2 * size.norm(); }, 1.0);
      } },
    { "two electrodes, a circuit in the good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        ends(p, size);
        hold(
          p,
          [size](const Point& x)
          { return x[0] > 0.6 * size[0] && x[0] < 0.9 * size[0] && x[1] < 0.5; },
          1.0);
      } },
    { "inclusions at random",
      [=](ElementProblem& p, const Point& size)
      {
        p.Part = [](const Point& x)
        { return std::sin(2.3 * x[0] + 1.0) * std::cos(1.9 * x[1]) + std::sin(1.7 * x[2]) > 0.2; };
        ends(p, size);
      } },
    { "voids at random",
      [=](ElementProblem& p, const Point& size)
      {
        p.Part = [](const Point& x)
        { return std::sin(2.3 * x[0] + 1.0) * std::cos(1.9 * x[1]) + std::sin(1.7 * x[2]) < 0.5; };
        ends(p, size);
      } },
    { "a film",
      [=](ElementProblem& p, const Point& size)
      {
        // A cell thick: each of its vertices is one of the good conductor, too.
        const double middle = std::floor(0.5 * size[0]);
        p.Part = [middle](const Point& x) { return x[0] > middle && x[0] < middle + 1.0 ? 0 : 1; };
        ends(p, size);
      } },
    { "cooled good conductor",
      [=](ElementProblem& p, const Point& size)
      {
        halve(p, size);
        hold(p, below(0, 0.5), 1.0);
        p.RobinConditions.push_back({ above(0, 0.7 * size[0]), [](const Point&) { return 3.0; },
          [](const Point&) { return Eigen::VectorXd::Constant(1, 20.0); } });
      } },
  };
}

/** The results of a solve of a mesh that cannot be read again, so that there is no correction,
 * unless the options say how. */
inline Report resultsOfOneReading(
  ElementProblem& problem, const SolveOptions& options = {}, std::int64_t block = 1000)
{
  MemorySource source(problem.mesh(), block);
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  Report report = solution->report();
  source.rewind(block);
  ProblemResults results(source.info(), problem, *solution);
  for (MeshBlock cells; source.next(cells);)
  {
    results.add(cells);
  }
  results.finish(report);
  return report;
}

/** The results of a solve with the options of a user who gave none, and others. */
inline Report resultsOf(
  ElementProblem& problem, const SolveOptions& others = {}, std::int64_t block = 1000)
{
  const StreamMesh& mesh = problem.mesh();
  SolveOptions options = others;
  options.again = [&mesh, block] { return std::make_unique<MemorySource>(mesh, block); };
  return resultsOfOneReading(problem, options, block);
}

/** Calls test(problem, name) for each shape, on a surface and a solid, with these contrasts. */
inline void forShapes(const std::vector<double>& contrasts, auto test)
{
  for (const bool solid : { false, true })
  {
    const StreamMesh mesh = toStream(solid ? tetBox(9, 5, 5, 0.15) : grid(17, 13, 0.1));
    const Point size = solid ? Point(8, 4, 4) : Point(16, 12 * std::sqrt(0.75), 0);
    std::vector<Shape> all = shapes();
    std::ranges::move(looselyHeldShapes(), std::back_inserter(all));
    for (const Shape& shape : all)
    {
      for (const double contrast : contrasts)
      {
        const std::string name =
          shape.name + (solid ? ", solid, " : ", surface, ") + scientific(contrast);
        SCOPED_TRACE(name);
        ElementProblem problem(mesh);
        shape.set(problem, size);
        problem.Parts = 2;
        problem.Conductivity = [&](const Point& x) -> Eigen::Matrix3d
        { return (problem.Part(x) == 0 ? 1.0 : contrast) * Eigen::Matrix3d::Identity(); };
        test(problem, name);
      }
    }
  }
}

} // namespace smg::testing
