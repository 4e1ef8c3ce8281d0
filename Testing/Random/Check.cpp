// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Check.h"

#include "Testing/Random/Doors.h"
#include "Testing/Random/Evaluation.h"
#include "Testing/Random/Relations.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/Error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;

/** Weights of the finest level are mostly of single precision: solutions may differ a little in
 * equations of bad condition, but then their residual is small. Something forgotten or wrong is
 * seen in both. */
constexpr double MaxError = 2e-6, MaxResidual = 3e-5;

bool hasNote(const Report& report, const char* part)
{
  return std::ranges::any_of(
    report.notes, [part](const std::string& note) { return note.find(part) != std::string::npos; });
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
    const MatrixXd& shape = oracle.shapes.gradients[static_cast<std::size_t>(original)];
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

/** Whether the integrals over the whole and over groups of cells are those of the values. */
std::string checkIntegrals(
  const Case& given, const Oracle& oracle, const MatrixXd& values, const Report& report)
{
  if (!given.problem.contains("integrals"))
  {
    return {};
  }
  const Evaluation at(given);
  std::vector<std::vector<bool>> parts{ std::vector<bool>(
    static_cast<std::size_t>(given.cells()), true) };
  for (std::size_t g = 0; g < given.groups.groups.size(); ++g)
  {
    if (given.groups.groups[g].of == GroupOf::Cells)
    {
      parts.push_back(at.cellsOf(g));
    }
  }
  if (parts.size() != report.integrals.size())
  {
    return "has another number of integrals";
  }
  const int columns = static_cast<int>(values.cols());
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(1 + 7 * columns), sizes = sums;
    for (std::int64_t c = 0; c < given.cells(); ++c)
    {
      const MatrixXd& shape = oracle.shapes.gradients[static_cast<std::size_t>(c)];
      if (!parts[k][static_cast<std::size_t>(c)] || at.flags()[static_cast<std::size_t>(c)] != 0)
      {
        continue;
      }
      const double measure = oracle.shapes.measure[c];
      Eigen::VectorXd own = Eigen::VectorXd::Zero(sums.size());
      own[0] = 1.0;
      for (int column = 0; column < columns; ++column)
      {
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (int i = 0; i < shape.rows(); ++i)
        {
          const double u = values(given.cell(c)[i], column);
          own[1 + column] += u / static_cast<double>(shape.rows());
          gradient += u * shape.row(i).transpose();
        }
        own.segment<3>(1 + columns + 3 * column) = gradient;
        own.segment<3>(1 + 4 * columns + 3 * column) =
          -oracle.conductivity[static_cast<std::size_t>(c)] * gradient;
      }
      sums += measure * own;
      sizes += measure * own.cwiseAbs();
    }
    const Report::Integral& found = report.integrals[k];
    std::vector<double> all{ found.measure };
    for (const auto* more : { &found.integral, &found.gradient, &found.flux })
    {
      all.insert(all.end(), more->begin(), more->end());
    }
    const double largest = sizes.size() > 1 ? sizes.tail(sizes.size() - 1).maxCoeff() : 0.0;
    for (Eigen::Index e = 0; e < sums.size(); ++e)
    {
      const double size = e == 0 ? sizes[0] : largest;
      if (!(std::abs(all[static_cast<std::size_t>(e)] - sums[e]) <= 1e-8 * size))
      {
        return "has another integral over " + found.name;
      }
    }
  }
  return {};
}

/** Solves in the way of the run; `failure` is set if there is more to say than of its values. */
Result solveAsTold(const Case& given, const Oracle& oracle, CheckedCase& to)
{
  const CaseRun& run = given.run;
  if (run.door == "vtk")
  {
    return solveFilter(given);
  }
  if (run.door == "file")
  {
    StreamMesh mesh;
    Result found = solveFile(given, mesh);
    to.failure = checkGradients(given, oracle, found.values, mesh);
    to.failure += checkIntegrals(given, oracle, found.values, found.report);
    return found;
  }
  if (run.memory == 0.0)
  {
    return solveInMemory(given, run);
  }
  const Result free = solveInMemory(given, run);
  const auto limit =
    static_cast<std::int64_t>(run.memory * static_cast<double>(free.report.pool_bytes_peak));
  try
  {
    Result found = solveInMemory(given, run, std::max<std::int64_t>(limit, 1));
    if (found.report.pool_bytes_peak > limit)
    {
      to.failure = "takes more memory than its limit";
    }
    return found;
  }
  catch (const Error& error)
  {
    to.isOutOfMemory = std::string(error.what()).find("memory") != std::string::npos;
    if (!to.isOutOfMemory)
    {
      throw;
    }
    return free;
  }
}

/** The values with 0 instead of NaN where nothing determines them, and only there; else throws
 * std::runtime_error. */
MatrixXd determinedOf(const Oracle& oracle, MatrixXd values)
{
  for (Eigen::Index v = 0; v < values.rows(); ++v)
  {
    if (!oracle.determined[static_cast<std::size_t>(v)])
    {
      if (!values.row(v).array().isNaN().all())
      {
        throw std::runtime_error(
          "vertex " + std::to_string(v) + " has a value, which nothing determines");
      }
      values.row(v).setZero();
    }
  }
  return values;
}

/** The answer to the case by way of a related one, without NaN. */
void checkRelation(
  const Case& given, const Oracle& oracle, const MatrixXd& expected, CheckedCase& to)
{
  const std::optional<Related> by = related(given, given.run.relation);
  if (!by)
  {
    return;
  }
  const Result other = solveInMemory(by->other, by->other.run);
  const MatrixXd values = determinedOf(oracle, by->back(other.values));
  const double size = expected.cwiseAbs().maxCoeff();
  if (by->isExact && !((values - expected).cwiseAbs().maxCoeff() <= 1e-13 * size))
  {
    to.failure = "is not the problem that is " + given.run.relation;
  }
  else if (!by->isExact && given.problem.value("weights", "") != "clamped")
  {
    compare(given, oracle, values, other.report, to, by->size);
    to.failure = to.failure.empty() ? "" : given.run.relation + ": " + to.failure;
  }
}

void checkSolve(const Case& given, CheckedCase& to)
{
  const Oracle oracle(given);
  const Result expected = solveInMemory(given, plain(given.run));
  const Result found = solveAsTold(given, oracle, to);
  // Acceleration may have had no room within the limit of memory, or have kept or begun with less.
  const bool isOther = (given.run.door != "c++" && given.run.order != "keep") ||
                       found.report.acceleration != expected.report.acceleration ||
                       hasNote(found.report, "near what conjugate gradients need");
  if (!to.failure.empty())
  {
    return;
  }
  if (!isOther && !sameBits(found.values, expected.values))
  {
    to.failure = "does not have the bits of the plain run, but differs by " +
                 std::to_string((found.values - expected.values).cwiseAbs().maxCoeff() /
                                std::numeric_limits<double>::epsilon()) +
                 " epsilon";
    return;
  }
  if (given.problem.value("weights", "") != "clamped")
  {
    compare(given, oracle, determinedOf(oracle, found.values), found.report, to);
  }
  if (to.failure.empty() && !given.run.relation.empty())
  {
    checkRelation(given, oracle, determinedOf(oracle, expected.values), to);
  }
}

/** Why the oracle refuses the case; empty: it does not. */
std::string refusalOf(const Case& given)
{
  if (given.job == "solve")
  {
    return Oracle(given).refusal;
  }
  bool isEmpty = false;
  const Evaluation at(given);
  for (const char* key : { "hold", "from" })
  {
    for (const nlohmann::json& place : given.problem.value(key, nlohmann::json::array()))
    {
      at.select(place, given.problem.value("wall", false) ? Of::Facets : Of::Vertices, isEmpty);
    }
  }
  if (given.problem.value("wall", false) && at.walls(given.problem.at("from")).empty())
  {
    isEmpty = true;
  }
  for (const nlohmann::json& handle : given.problem.value("handles", nlohmann::json::array()))
  {
    at.select(handle.at("region"), Of::Vertices, isEmpty);
  }
  return isEmpty ? "a place is empty" : "";
}

} // namespace

void compare(const Case& given, const Oracle& oracle, const MatrixXd& values, const Report& report,
  CheckedCase& to, double size)
{
  to.hasConverged = report.converged;
  to.isApproximate = hasNote(report, "so flat") || hasNote(report, "lost in rounding");
  const MatrixXd& a = oracle.matrix;
  // Loads that cancel leave their rounding.
  const double scale = std::max({ size, oracle.solution.cwiseAbs().maxCoeff(),
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
      const double terms = a.row(v).cwiseAbs() * (values.col(k).cwiseAbs().array() + size).matrix();
      const double rest = std::abs(a.row(v).dot(values.col(k)) - oracle.rightSide(v, k));
      residual = std::max(residual,
        rest / std::max(terms + oracle.loads(v, k) + std::abs(oracle.rightSide(v, k)), 1e-300));
    }
  }
  if (to.hasConverged && !to.isApproximate && to.error > MaxError && residual > MaxResidual)
  {
    std::ostringstream text;
    text << "differs from the direct solution by " << to.error << ", residual " << residual;
    to.failure = text.str();
  }
}

CheckedCase check(const Case& given)
{
  static const std::map<std::string, void (*)(const Case&, CheckedCase&)> jobs{
    { "solve", checkSolve }, { "deform", checkDeformation }, { "smooth", checkSmoothing },
    { "distance", checkDistance }, { "blend", checkBlend }
  };
  CheckedCase checked;
  std::string refusal;
  try
  {
    refusal = refusalOf(given);
    jobs.at(given.job)(given, checked);
    if (!refusal.empty() && checked.failure.empty())
    {
      checked.failure = "is done although " + refusal;
    }
  }
  catch (const Error& error)
  {
    checked.isRefused = true;
    // Cells nearly flat in a mesh that nothing holds, or whose weights carry a scale far away.
    const std::string what = error.what();
    const bool isSingular = what.find("too many orders of magnitude") != std::string::npos ||
                            what.find("leaves the range of numbers") != std::string::npos;
    if (refusal.empty() && !isSingular)
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
