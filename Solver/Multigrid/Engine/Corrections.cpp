// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/Corrections.h"

#include "Solver/Core/Progress.h"
#include "Solver/Multigrid/Engine/Convergence.h"
#include "Solver/Multigrid/Engine/PoissonSolver.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

// Iterative refinement (Wilkinson 1963). In a good conductor the values of the solution differ in
// their last digits alone, and its flow is the conductivity times what is left of these: at 1e12
// four digits. The residual that a solution leaves is a sum of weights times differences of values,
// which are exact where values are close. So it is known to the digits of what flows, and its
// correction is a problem like any other, of which the values are small.
//
// A correction costs a solve, since the hierarchy is built anew.

namespace smg
{
namespace
{

/** The sum of two numbers, and what rounding takes from it, exactly (Knuth 1969). */
std::pair<double, double> exactSum(double a, double b)
{
  const double sum = a + b;
  const double ofB = sum - a;
  return { sum, (a - (sum - ofB)) + (b - ofB) };
}

/** Adds the costs of a correction, whose relative residuals are `scale` times as large relative to
 * those of the solution. */
void addCosts(Report& report, const Report& correction, double scale)
{
  report.passes += correction.passes;
  report.cycles += correction.cycles;
  for (const double residual : correction.residuals)
  {
    report.residuals.push_back(scale * residual);
  }
  for (Report::Pass pass : correction.by_pass)
  {
    pass.residual *= scale;
    report.by_pass.push_back(pass);
  }
  report.converged = correction.converged; // only what has converged is corrected
  if (correction.converged)
  {
    // Of before.
    std::erase_if(report.notes, isOnResidual);
    std::erase_if(report.warnings, isOnResidual);
  }
  for (const std::string& note : correction.notes)
  {
    // What the assembly says of the mesh, it has said before.
    if (std::ranges::find(report.notes, note) == report.notes.end())
    {
      report.notes.push_back("the correction of rounding: " + note);
    }
  }
  report.peak_nodes = std::max(report.peak_nodes, correction.peak_nodes);
  report.pool_bytes_peak = std::max(report.pool_bytes_peak, correction.pool_bytes_peak);
  report.rss_bytes_peak = std::max(report.rss_bytes_peak, correction.rss_bytes_peak);
  report.scratch_bytes_peak += correction.scratch_bytes_peak;
  report.bytes_read += correction.bytes_read;
  report.bytes_written += correction.bytes_written;
  for (const Report::Traffic& traffic : correction.bytes_by_kind)
  {
    const auto same = std::ranges::find_if(report.bytes_by_kind, [&](const Report::Traffic& other)
      { return other.kind == traffic.kind && other.level == traffic.level; });
    if (same == report.bytes_by_kind.end())
    {
      report.bytes_by_kind.push_back(traffic);
      continue;
    }
    same->read += traffic.read;
    same->written += traffic.written;
  }
  Report::Seconds& seconds = report.seconds;
  seconds.build += correction.seconds.build;
  seconds.solve += correction.seconds.solve;
  seconds.coarse += correction.seconds.coarse;
  seconds.io_wait += correction.seconds.io_wait;
  seconds.build_io_wait += correction.seconds.build_io_wait;
  seconds.total += correction.seconds.total;
  report.cpu_seconds += correction.cpu_seconds;
}

} // namespace

/** The last digit of a value makes flow as many times more than flows through the whole as
 * conductivities differ. Measured over the shapes of Testing/Solver/ContrastTesting.h. */
double correctionTolerance(double contrast, double tolerance)
{
  constexpr double Digit = std::numeric_limits<double>::epsilon();
  const double left = contrast * Digit / (IterateFlow::Judged * tolerance);
  return left >= 1.0 && tolerance != SolveOptions::AutomaticTolerance
           ? std::min(IterateFlow::Judged, 1.0 / left)
           : 1.0;
}

UncorrectedSolution::UncorrectedSolution(
  std::unique_ptr<Solution> solution, const std::string& reason)
  : First(std::move(solution))
  , Reported(this->First->report())
{
  this->Reported.warn("the solution has no more digits than a double, which fluxes in good "
                      "conductors need: its correction failed (" +
                      reason + ')');
}

CorrectedSolution::CorrectedSolution(std::unique_ptr<Solution> solution,
  std::unique_ptr<Solution> correction, double ofCorrection, double ofSolution)
  : First(std::move(solution))
  , Correction(std::move(correction))
  , Reported(this->First->report())
{
  addCosts(
    this->Reported, this->Correction->report(), ofSolution > 0.0 ? ofCorrection / ofSolution : 1.0);
}

/** Adds up values with what the solution has beyond their digits. A value that nothing determines
 * is not a number, and has no rest. Whoever wants the rest has read the values: these are summed up
 * once. */
void CorrectedSolution::add(std::int64_t first, std::int64_t count, std::size_t numbers)
{
  if (first == this->Begin && numbers == this->Sum.size())
  {
    return;
  }
  this->Begin = -1; // until all is read
  for (std::vector<double>* values : { &this->Sum, &this->Rest, &this->Added })
  {
    values->assign(numbers, 0.0);
  }
  this->First->read(first, count, this->Sum);
  if (this->First->hasRest())
  {
    this->First->readRest(first, count, this->Rest);
  }
  this->Correction->read(first, count, this->Added);
  for (std::size_t e = 0; e < numbers; ++e)
  {
    const auto [sum, rest] = exactSum(this->Sum[e], this->Added[e]);
    const auto [all, left] = exactSum(sum, rest + this->Rest[e]);
    this->Sum[e] = all;
    this->Rest[e] = std::isfinite(left) ? left : 0.0;
  }
  this->Begin = first;
}

void CorrectedSolution::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  this->add(first, count, values.size());
  std::ranges::copy(this->Sum, values.begin());
}

void CorrectedSolution::readRest(std::int64_t first, std::int64_t count, std::span<double> values)
{
  this->add(first, count, values.size());
  std::ranges::copy(this->Rest, values.begin());
}

std::unique_ptr<Solution> corrected(const CompiledOperators& operators, Problem& problem,
  const SolveOptions& options, std::unique_ptr<Solution> solution, const PoissonSolver& solver)
{
  // A residual that is somewhat larger than the goal is no reason to build the hierarchy once more.
  constexpr double Enough = 10.0;
  constexpr int Most = 4;
  constexpr double OfRest = 0.8; // what a correction takes of the progress that is left
  const SolveNorms& norms = solver.norms();
  const double goal = options.tolerance * IterateFlow::Judged * norms.flow;
  // The rounding of independent terms is a bound of what it does to their sums.
  double left = std::max(norms.residual, 0.1 * norms.rounding);
  SolveOptions again = options;
  again.checkpoint = {};
  double done = solver.done();
  const auto leave = [&again](const PoissonSolver& kept)
  {
    again.memoryLimit = std::max<std::int64_t>(1, again.memoryLimit - kept.usedBytes());
    again.scratchLimit = again.scratchLimit > 0
                           ? std::max<std::int64_t>(1, again.scratchLimit - kept.usedScratch())
                           : 0;
  };
  leave(solver);
  for (int n = 0; n < Most && left > Enough * goal; ++n)
  {
    again.maxCycles = options.maxCycles - solution->report().cycles;
    if (again.maxCycles < 1)
    {
      return std::make_unique<UncorrectedSolution>(
        std::move(solution), "no V-cycle is left of those that are allowed");
    }
    // Another one may follow.
    const double end = done + OfRest * (1.0 - done);
    again.progress = ProgressPart{ done, end }.of(options.progress);
    done = end;
    PoissonSolver next(operators, problem.columns(), again);
    std::unique_ptr<Solution> correction;
    try
    {
      const std::unique_ptr<MeshSource> mesh = options.again();
      correction = next.correct(*mesh, problem, *solution, goal, norms.scales);
    }
    catch (const Cancelled&)
    {
      throw;
    }
    catch (const Error& error)
    {
      return std::make_unique<UncorrectedSolution>(std::move(solution), error.what());
    }
    leave(next);
    const double before = std::exchange(left, next.norms().residual);
    solution = std::make_unique<CorrectedSolution>(
      std::move(solution), std::move(correction), next.norms().initial, norms.initial);
    if (left > 0.1 * before)
    {
      break; // what is left is not due to rounding
    }
  }
  return solution;
}

} // namespace smg
