// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Check.h"

#include "Testing/Random/Oracle.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/SolveMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/SolvedMesh.h"
#include "smg/VsmReader.h"

#include <Eigen/Dense>

#include <cmath>
#include <sstream>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;

/** Weights of the finest level are mostly of single precision, and those of very flat cells are
 * scaled down (flatnessFactor): solutions may differ a little in equations of bad condition, but
 * then their residual is small. Something forgotten or wrong is seen in both. */
constexpr double MostError = 2e-6, MostResidual = 1e-5, MostResidualOfNeedles = 3e-2;

/** The least quotient of measure and power of the longest edge: 0.43 or 0.12 of a regular cell. */
double worstQuality(const Case& given, const Oracle& oracle)
{
  double worst = 1.0;
  for (const Eigen::MatrixXd& gradients : oracle.gradients)
  {
    if (gradients.size() > 0)
    {
      // 1 / the height over the longest edge, up to a factor.
      double longest = 0.0;
      const auto cell = &gradients - oracle.gradients.data();
      for (int i = 0; i < gradients.rows(); ++i)
      {
        for (int j = 0; j < i; ++j)
        {
          const auto point = [&](int k)
          { return Eigen::Vector3d::Map(&given.points[3 * given.cell(cell)[k]]); };
          longest = std::max(longest, (point(i) - point(j)).norm());
        }
      }
      worst = std::min(worst, 1.0 / (longest * gradients.rowwise().norm().maxCoeff()));
    }
  }
  return worst;
}

SolveOptions optionsOf(const CaseRun& run)
{
  SolveOptions options;
  options.threads = run.threads;
  options.inCore = run.inCore;
  options.coreNodes = run.coreNodes;
  options.blockNodes = run.blockNodes;
  options.sweeps = run.sweeps;
  options.acceleration = static_cast<AccelerationKind>(run.acceleration);
  options.tolerance = 1e-11;
  options.maxCycles = 400;
  return options;
}

/** The run that all others must equal to the last bit. */
CaseRun plain(const CaseRun& run)
{
  CaseRun in = run;
  in.blockCells = INT64_MAX / 2;
  in.threads = 1;
  in.inCore = true;
  in.cancelAt = 0;
  in.door = "c++";
  return in;
}

struct Result
{
  MatrixXd values; ///< vertices of the case x columns
  bool hasConverged = true;
};

Result solveInMemory(const Case& given, const CaseRun& run)
{
  const ProblemDescription description = readProblemText(given.problem.dump(), "problem");
  MemorySource source(given.stream(), run.blockCells);
  DescribedProblem problem(description, source.info());
  problem.prepare(source);
  source.rewind(run.blockCells);
  SolveOptions options = optionsOf(run);
  const TemporaryFolder folder;
  options.scratch = folder.path();
  if (run.cancelAt > 0)
  {
    options.checkpoint = { folder / "checkpoint", "mesh", "problem" };
    int calls = 0;
    options.progress = [&](double) { return ++calls != run.cancelAt; };
    try
    {
      const Solved solved = solveMesh(source, problem, options);
      return { solved.values, solved.report.converged };
    }
    catch (const Cancelled&)
    {
      source.rewind(run.blockCells);
      options.progress = {};
    }
  }
  const Solved solved = solveMesh(source, problem, options);
  return { solved.values, solved.report.converged };
}

/** Whether the gradients and fluxes of the cells are those of the values. */
std::string checkGradients(
  const Case& given, const Oracle& oracle, const MatrixXd& values, const StreamMesh& result)
{
  const auto columnOf = [&result](const char* name) -> const Column&
  {
    return *std::ranges::find_if(
      result.cellColumns, [name](const Column& column) { return column.spec.name == name; });
  };
  const Column& gradients = columnOf("Gradient");
  const Column& fluxes = columnOf("Flux");
  const Column& ids = columnOf(OriginalCellIdName);
  for (std::int64_t c = 0; c < result.cells(); ++c)
  {
    const auto original = static_cast<std::int64_t>(ids.value(c));
    const MatrixXd& shape = oracle.gradients[static_cast<std::size_t>(original)];
    for (int column = 0; shape.size() > 0 && column < values.cols(); ++column)
    {
      Eigen::Vector3d expected = Eigen::Vector3d::Zero(), found, flux;
      double size = 0.0;
      for (int k = 0; k < shape.rows(); ++k)
      {
        const double u = values(given.cell(original)[k], column);
        expected += u * shape.row(k).transpose();
        size += std::abs(u) * shape.row(k).norm();
      }
      for (int k = 0; k < 3; ++k)
      {
        found[k] = gradients.value(c, 3 * column + k);
        flux[k] = fluxes.value(c, 3 * column + k);
      }
      const Eigen::Matrix3d& k = oracle.conductivity[static_cast<std::size_t>(original)];
      if (!((found - expected).norm() <= 1e-8 * size) ||
          !((flux + k * expected).norm() <= 1e-8 * size * k.norm()))
      {
        return "cell " + std::to_string(original) + " has another gradient or flux";
      }
    }
  }
  return {};
}

/** By way of files, with results; `failure` is set if these are not those of the solution. */
Result solveFile(const Case& given, const Oracle& oracle, std::string& failure)
{
  const CaseRun& run = given.run;
  const TemporaryFolder folder;
  given.writeVtk(folder / "mesh.vtk");
  ConversionOptions conversion;
  conversion.order = run.order == "keep"   ? StreamOrder::Keep
                     : run.order == "axis" ? StreamOrder::Axis
                                           : StreamOrder::BreadthFirst;
  conversion.threads = run.threads;
  conversion.scratch = folder.path();
  convert(folder / "mesh.vtk", folder / "mesh.vsm", conversion);
  const VsmReader mesh(folder / "mesh.vsm");
  const ProblemDescription description = readProblemText(given.problem.dump(), "problem");
  DescribedProblem problem(description, mesh.info());
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source());
  SolveOptions options = optionsOf(run);
  options.scratch = folder.path();
  const std::unique_ptr<Solution> solution = solve(*source(), problem, options);
  ResultOptions results;
  results.gradient = results.flux = true;
  results.threads = run.threads;
  SolvedMesh solved(mesh, problem, *solution, results);
  const StreamMesh result = collect(solved);
  Report report = solution->report();
  solved.finish(report);
  const auto columnOf = [&](const std::string& name) -> const Column&
  {
    return *std::ranges::find_if(
      result.vertexColumns, [&](const Column& column) { return column.spec.name == name; });
  };
  Result found{ MatrixXd::Zero(given.vertices(), solution->columns()), report.converged };
  for (std::int64_t v = 0; v < result.vertices(); ++v)
  {
    for (int k = 0; k < solution->columns(); ++k)
    {
      found.values(static_cast<std::int64_t>(columnOf(OriginalIdName).value(v)), k) =
        columnOf("Solution").value(v, k);
    }
  }
  failure = checkGradients(given, oracle, found.values, result);
  return found;
}

/** Compares with the oracle. */
void compare(const Case& given, const Oracle& oracle, const MatrixXd& values, CheckedCase& to)
{
  const MatrixXd& a = oracle.matrix;
  // Loads that cancel leave their rounding.
  const double scale = std::max({ oracle.solution.cwiseAbs().maxCoeff(),
    oracle.loads.maxCoeff() / a.diagonal().maxCoeff(), std::numeric_limits<double>::min() });
  double residual = 0.0;
  for (std::int64_t v = 0; v < given.vertices(); ++v)
  {
    if (!oracle.determined[static_cast<std::size_t>(v)])
    {
      continue;
    }
    for (int k = 0; k < values.cols(); ++k)
    {
      if (!std::isfinite(values(v, k)))
      {
        to.failure = "vertex " + std::to_string(v) + " is not a number";
        return;
      }
      to.error = std::max(to.error, std::abs(values(v, k) - oracle.solution(v, k)) / scale);
      const double terms = a.row(v).cwiseAbs() * values.col(k).cwiseAbs();
      const double rest = std::abs(a.row(v).dot(values.col(k)) - oracle.rightSide(v, k));
      residual = std::max(residual,
        rest / std::max(terms + oracle.loads(v, k) + std::abs(oracle.rightSide(v, k)), 1e-300));
    }
  }
  // Equations of bad condition have other solutions within their rounding.
  const double mostResidual =
    worstQuality(given, oracle) < 1e-3 ? MostResidualOfNeedles : MostResidual;
  if (to.hasConverged && to.error > MostError && residual > mostResidual)
  {
    std::ostringstream text;
    text << "differs from the direct solution by " << to.error << ", residual " << residual;
    to.failure = text.str();
  }
}

} // namespace

CheckedCase check(const Case& given)
{
  CheckedCase checked;
  std::string refusal;
  try
  {
    const Oracle oracle(given);
    refusal = oracle.refusal;
    const Result expected = solveInMemory(given, plain(given.run));
    if (!refusal.empty())
    {
      checked.failure = "is solved although " + refusal;
      return checked;
    }
    checked.hasConverged = expected.hasConverged;
    const bool isFile = given.run.door == "file";
    std::string wrongResults;
    const Result found =
      isFile ? solveFile(given, oracle, wrongResults) : solveInMemory(given, given.run);
    if ((!isFile || given.run.order == "keep") && !sameBits(found.values, expected.values))
    {
      checked.failure = "does not have the bits of the plain run";
    }
    else if (!wrongResults.empty())
    {
      checked.failure = wrongResults;
    }
    else if (given.problem.value("weights", "") != "clamped")
    {
      checked.hasConverged = found.hasConverged;
      compare(given, oracle, found.values, checked);
    }
  }
  catch (const Error& error)
  {
    checked.isRefused = true;
    if (refusal.empty())
    {
      checked.failure = std::string("is refused: ") + error.what();
    }
  }
  catch (const std::exception& error)
  {
    checked.failure = std::string("fails: ") + error.what();
  }
  return checked;
}

} // namespace smg::testing
