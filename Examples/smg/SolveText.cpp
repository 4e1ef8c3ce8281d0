// SPDX-License-Identifier: BSD-3-Clause
#include "SolveText.h"

#include "Solver/Core/Text.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace
{

/** What the engine of the report calls so many iterations. */
const char* iterations(const smg::Report& report, int count)
{
  return report.distributed ? (count == 1 ? "iteration" : "iterations")
                            : (count == 1 ? "V-cycle" : "V-cycles");
}

} // namespace

void warnOfSolve(const smg::Report& report, const smg::SolveOptions& options)
{
  bool isAdvised = false;
  const auto warning = [&](const std::string& what, double residual, int cycles)
  {
    std::fprintf(stderr, "smg: warning: %snot converged: the relative residual is %.3g after %d %s",
      what.c_str(), residual, cycles, iterations(report, cycles));
    if (options.tolerance != smg::SolveOptions::AutomaticTolerance)
    {
      std::fprintf(stderr, ", the tolerance %.3g", options.tolerance);
    }
    // What has stagnated does not get better by that.
    if (cycles >= options.maxCycles && !std::exchange(isAdvised, true))
    {
      std::fputs(": raise --max-cycles or --tolerance", stderr);
    }
    std::fputc('\n', stderr);
  };
  for (const smg::Report::Step& step : report.steps)
  {
    if (!step.converged)
    {
      warning(step.name + ": ", step.residual, step.cycles);
    }
  }
  if (report.steps.empty() && !report.converged)
  {
    warning("", report.residual(), report.cycles);
  }
}

namespace
{

/** For example " 1.5 2", one number per column; "unknown" for what is null in the report. */
std::string listOf(const std::vector<double>& numbers)
{
  std::string list;
  for (const double number : numbers)
  {
    char text[32];
    std::snprintf(text, sizeof text, " %.6g", number);
    list += std::isnan(number) ? " unknown" : text;
  }
  return list;
}

/** For example "vertices 7, area 1.5, "; Dirichlet vertices need not span a facet. */
std::string extentOf(const smg::Report::Condition& condition)
{
  std::string extent;
  if (condition.vertices > 0)
  {
    extent = "vertices " + std::to_string(condition.vertices) + ", ";
  }
  if (condition.area > 0.0)
  {
    extent += "area" + listOf({ condition.area }) + ", ";
  }
  return extent;
}

} // namespace

void printSolve(const smg::Report& report)
{
  std::printf("%lld vertices, %s, ", static_cast<long long>(report.vertices),
    smg::counted(report.cells, "cell", "cells").c_str());
  if (report.distributed)
  {
    std::printf("%s, %s, %s\n",
      smg::counted(report.distributed->processes, "process", "processes").c_str(),
      smg::counted(report.cycles, "iteration", "iterations").c_str(),
      report.residualText().c_str());
  }
  else
  {
    std::printf("%zu %s, %d %s in %d %s, %s\n", report.levels.size(),
      report.levels.size() == 1 ? "level" : "levels", report.cycles,
      iterations(report, report.cycles), report.passes, report.passes == 1 ? "pass" : "passes",
      report.residualText().c_str());
  }
  for (const smg::Report::Step& step : report.steps)
  {
    std::printf("  %s: %d %s", step.name.c_str(), step.cycles, iterations(report, step.cycles));
    if (step.cycles > 0)
    {
      std::printf(", relative residual %.3g", step.residual);
    }
    std::printf("\n");
  }
  for (const smg::Report::Condition& condition : report.conditions)
  {
    if (std::isnan(condition.mean.front()))
    {
      std::printf("  %s: without effect\n", smg::oneLine(condition.name).c_str());
      continue;
    }
    std::printf("  %s: %smean%s, flux into the body%s\n", smg::oneLine(condition.name).c_str(),
      extentOf(condition).c_str(), listOf(condition.mean).c_str(), listOf(condition.flux).c_str());
  }
  for (const smg::Report::Contact& contact : report.contacts)
  {
    std::printf("  %s: area%s, mean step%s, flow%s\n", smg::oneLine(contact.name).c_str(),
      listOf({ contact.area }).c_str(), listOf(contact.step).c_str(), listOf(contact.flow).c_str());
  }
  for (const smg::Report::Integral& part : report.integrals)
  {
    std::printf("  %s: measure%s, integral%s, mean%s, of the flux%s\n",
      smg::oneLine(part.name).c_str(), listOf({ part.measure }).c_str(),
      listOf(part.integral).c_str(), listOf(part.mean).c_str(), listOf(part.flux).c_str());
  }
  for (const smg::Report::Seam& seam : report.seams)
  {
    std::printf("  %s: the largest step between patches was %.3g and is %.3g\n",
      smg::oneLine(seam.column).c_str(), seam.before, seam.after);
  }
}
