// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/SolveSummary.h"

#include "Solver/Core/GroupedDigits.h"

#include <iomanip>
#include <sstream>

namespace smg
{

SolveSummary SolveSummary::of(const Report& report, int columns)
{
  SolveSummary summary;
  summary.report = report.json();
  for (const std::string& note : report.notes)
  {
    summary.notes += (summary.notes.empty() ? "" : "\n") + note;
  }
  summary.warnings = report.warnings;
  summary.vertices = report.vertices;
  summary.byPass = report.by_pass;
  summary.columns = columns;
  summary.residual = report.residual();
  summary.cycles = report.cycles;
  summary.passes = report.passes;
  summary.processes = report.distributed ? report.distributed->processes : 0;
  summary.converged = report.converged;
  summary.peakMemory = report.pool_bytes_peak;
  return summary;
}

SolveSummary SolveSummary::failed(const std::string& sentence)
{
  SolveSummary summary;
  summary.error = sentence;
  return summary;
}

std::string SolveSummary::outcome() const
{
  if (this->isCancelled)
  {
    return "Cancelled.";
  }
  if (!this->error.empty())
  {
    return "Failed: " + this->error;
  }
  if (this->report.empty())
  {
    return "";
  }
  constexpr double MiB = 1 << 20;
  std::ostringstream text;
  const std::string place = this->where();
  text << place << (place.empty() ? "" : " ") << (this->converged ? "Converged" : "Not converged");
  if (this->cycles > 0)
  {
    text << " after " << this->cycles << (this->processes > 0 ? " iteration" : " V-cycle")
         << (this->cycles == 1 ? "" : "s");
  }
  if (this->processes > 0)
  {
    text << " on " << this->processes << (this->processes == 1 ? " process, " : " processes, ");
  }
  else
  {
    text << " in " << this->passes << (this->passes == 1 ? " pass, " : " passes, ");
  }
  if (this->cycles > 0)
  {
    text << "relative residual " << std::setprecision(3) << this->residual << ", ";
  }
  text << std::fixed << std::setprecision(1) << static_cast<double>(this->peakMemory) / MiB
       << " MiB";
  return text.str();
}

std::string SolveSummary::where() const
{
  if (this->fullPoints == 0 || !this->error.empty())
  {
    return "";
  }
  if (this->previewPoints == 0)
  {
    return "On the full mesh of " + groupedDigits(this->fullPoints) + " points.";
  }
  return "On the preview only: " + groupedDigits(this->previewPoints) + " of " +
         groupedDigits(this->fullPoints) + " points" +
         (this->doubt.empty() ? "." : ", " + this->doubt);
}

} // namespace smg
