// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/AddStep.h"

#include <algorithm>
#include <vector>

namespace smg
{

namespace
{

void addTraffic(std::vector<Report::Traffic>& total, const Report::Traffic& more)
{
  const auto same = std::ranges::find_if(total,
    [&more](const Report::Traffic& t) { return t.kind == more.kind && t.level == more.level; });
  if (same == total.end())
  {
    total.push_back(more);
    return;
  }
  same->read += more.read;
  same->written += more.written;
}

/** Adds those that are not there yet. */
void addNotes(std::vector<std::string>& notes, const std::vector<std::string>& more)
{
  for (const std::string& note : more)
  {
    if (std::ranges::find(notes, note) == notes.end())
    {
      notes.push_back(note);
    }
  }
}

} // namespace

void addStep(Report& total, const Report& step, const std::string& name)
{
  total.converged = (total.steps.empty() || total.converged) && step.converged;
  total.steps.push_back({ name, step.cycles, step.residual(), step.converged });
  total.vertices = step.vertices;
  total.cells = step.cells;
  total.levels = step.levels;
  total.passes += step.passes;
  total.cycles += step.cycles;
  total.residuals.insert(total.residuals.end(), step.residuals.begin(), step.residuals.end());
  total.by_pass.insert(total.by_pass.end(), step.by_pass.begin(), step.by_pass.end());
  total.acceleration = step.acceleration;
  total.peak_nodes = std::max(total.peak_nodes, step.peak_nodes);
  total.pool_bytes_peak = std::max(total.pool_bytes_peak, step.pool_bytes_peak);
  total.rss_bytes_peak = std::max(total.rss_bytes_peak, step.rss_bytes_peak);
  total.bytes_read += step.bytes_read;
  total.bytes_written += step.bytes_written;
  for (const Report::Traffic& traffic : step.bytes_by_kind)
  {
    addTraffic(total.bytes_by_kind, traffic);
  }
  total.seconds.build += step.seconds.build;
  total.seconds.solve += step.seconds.solve;
  total.seconds.coarse += step.seconds.coarse;
  total.seconds.io_wait += step.seconds.io_wait;
  total.seconds.build_io_wait += step.seconds.build_io_wait;
  total.threads = step.threads;
  total.prescribed = step.prescribed;
  total.held = step.held;
  total.degenerate_cells = step.degenerate_cells;
  total.coincident_cells = step.coincident_cells;
  total.clamped_weights = step.clamped_weights;
  total.components = step.components;
  total.free_components = step.free_components;
  addNotes(total.notes, step.notes);
  addNotes(total.warnings, step.warnings);
}

} // namespace smg
