// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

#include <cstdint>

namespace smg
{

/** The part of a report that the passes of a solve set, for StateWriter and StateReader; the rest
 * is set at its end. */
template <class State>
struct ReportState
{
  Report& report;

  void exchange(State& state)
  {
    Report& r = this->report;
    state.part("report");
    state(r.vertices, r.cells, r.levels, r.passes, r.cycles, r.residuals, r.acceleration);
    this->exchangeSteps(state);
    this->exchangePasses(state);
    state(r.converged, r.seconds, r.cpu_seconds, r.rss_bytes_peak, r.prescribed, r.shared, r.held,
      r.degenerate_cells, r.coincident_cells, r.clamped_weights, r.components, r.free_components,
      r.removed_source, r.notes, r.warnings);
  }

private:
  void exchangePasses(State& state)
  {
    auto passes = static_cast<std::uint64_t>(this->report.by_pass.size());
    state(passes);
    this->report.by_pass.resize(passes);
    for (Report::Pass& pass : this->report.by_pass)
    {
      state(pass.residual, pass.seconds, pass.read, pass.written, pass.pool_bytes);
    }
  }

  void exchangeSteps(State& state)
  {
    auto steps = static_cast<std::uint8_t>(this->report.steps.size());
    state(steps);
    this->report.steps.resize(steps);
    for (Report::Step& step : this->report.steps)
    {
      state(step.name, step.cycles, step.residual, step.converged);
    }
  }
};

} // namespace smg
