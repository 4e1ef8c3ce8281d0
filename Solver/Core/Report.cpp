// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Report.h"

#include <nlohmann/json.hpp>

#include <cstdio>

// The report as JSON: the text that --report writes, the filters return and scripts read. Entries
// are in the order in which they are inserted here. Those of only some computations (passes, steps,
// volumes, seams, distances, processes ...) are left out where they do not apply, all others are
// always there. docs/solve.md describes them.

namespace smg
{
namespace
{

/** The smallest or largest value of each column, with the vertex that has it. */
nlohmann::ordered_json extremes(const std::vector<Report::Extreme>& of)
{
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Report::Extreme& extreme : of)
  {
    out.push_back({ { "value", extreme.value }, { "vertex", extreme.vertex } });
  }
  return out;
}

/** What the solution makes of the conditions, and its energy and balance. JSON has no NaN: numbers
 * that are not known are written as null. */
void addResults(const Report& report, nlohmann::ordered_json& out)
{
  // An array even if it is empty, so that a script may loop over it without a test.
  out["conditions"] = nlohmann::ordered_json::array();
  for (const Report::Condition& condition : report.conditions)
  {
    out["conditions"].push_back({ { "name", condition.name }, { "vertices", condition.vertices },
      { "area", condition.area }, { "mean", condition.mean }, { "flux", condition.flux } });
  }
  for (const Report::Part& part : report.parts)
  {
    out["parts"].push_back({ { "name", part.name }, { "measure", part.measure },
      { "gradient", part.gradient }, { "flux", part.flux } });
  }
  out["energy"] = report.energy;
  out["mean"] = report.mean;
  out["minimum"] = extremes(report.minimum);
  out["maximum"] = extremes(report.maximum);
  out["source"] = report.source;
  out["screening"] = report.screening;
  out["balance"] = report.balance;
}

/** The figures of a smoothing, a blend, a distance or a deformation. */
void addJob(const Report& report, nlohmann::ordered_json& out)
{
  // The volume of a surface with a boundary is not a number, hence null.
  if (report.volume)
  {
    out["volume"] = { { "before", report.volume->before }, { "after", report.volume->after },
      { "swept", report.volume->swept } };
  }
  for (const Report::Seam& seam : report.seams)
  {
    out["seams"].push_back(
      { { "column", seam.column }, { "before", seam.before }, { "after", seam.after } });
  }
  // What a blend has clipped goes with its seams.
  if (!report.seams.empty())
  {
    out["clipped"] = report.clipped;
  }
  if (report.areas)
  {
    const char* const measure = report.areas->isVolume ? "volume" : "area";
    out["areas"] = { { "measure", measure }, { "cells", report.areas->cells },
      { "total", report.areas->total } };
    if (report.areas->hasTags)
    {
      out["areas"]["by_tag"] = nlohmann::ordered_json::array();
    }
    for (const Report::Area& part : report.areas->by_tag)
    {
      out["areas"]["by_tag"].push_back(
        { { "tag", part.tag }, { "cells", part.cells }, { measure, part.area } });
    }
  }
  if (report.distance)
  {
    out["distance"] = { { "exact", report.distance->exact },
      { "sources", report.distance->sources }, { "unreached", report.distance->unreached },
      { "unsettled", report.distance->unsettled },
      { "mesh_readings", report.distance->mesh_readings }, { "maximum", report.distance->maximum },
      { "mean", report.distance->mean } };
    for (const Report::Path& path : report.distance->paths)
    {
      out["distance"]["paths"].push_back({ { "to", path.to }, { "from", path.from },
        { "length", path.length }, { "points", path.points } });
    }
  }
  if (report.inverted)
  {
    nlohmann::ordered_json& inverted = out["inverted"];
    inverted = { { "cells", report.inverted->cells }, { "share", report.inverted->share } };
    // Without an inverted cell there is no worst one.
    if (report.inverted->cells > 0)
    {
      inverted["worst"] = { { "cell", report.inverted->worst }, { "ratio", report.inverted->ratio },
        { "place", report.inverted->place } };
    }
  }
  // One figure of memory for each process, in their order.
  if (report.distributed)
  {
    out["distributed"] = { { "processes", report.distributed->processes },
      { "setups", report.distributed->setups }, { "iterations", report.distributed->iterations },
      { "pool_bytes_peak", report.distributed->pool_bytes_peak },
      { "rss_bytes_peak", report.distributed->rss_bytes_peak } };
  }
}

/** Without passes, as in a solve by several processes, there is no entry. */
void addPasses(const Report& report, nlohmann::ordered_json& out)
{
  for (const Report::Pass& pass : report.by_pass)
  {
    out["by_pass"].push_back({ { "residual", pass.residual }, { "seconds", pass.seconds },
      { "read", pass.read }, { "written", pass.written }, { "pool_bytes", pass.pool_bytes } });
  }
  for (const Report::Stage& stage : report.stages)
  {
    out["stages"].push_back({ { "name", stage.name }, { "level", stage.level },
      { "first", stage.first }, { "seconds", stage.seconds } });
  }
}

} // namespace

std::string Report::json(int indent) const
{
  nlohmann::ordered_json out;
  out["vertices"] = this->vertices;
  out["cells"] = this->cells;
  out["levels"] = nlohmann::ordered_json::array();
  for (const Level& level : this->levels)
  {
    out["levels"].push_back(
      { { "nodes", level.nodes }, { "nonzeros", level.nonzeros }, { "window", level.window } });
  }
  out["passes"] = this->passes;
  out["resumed_passes"] = this->resumed_passes;
  out["cycles"] = this->cycles;
  out["residuals"] = this->residuals;
  if (!this->relative_to.empty())
  {
    out["relative_to"] = this->relative_to;
  }
  addPasses(*this, out);
  out["acceleration"] = this->acceleration;
  out["converged"] = this->converged;
  for (const Step& step : this->steps)
  {
    out["steps"].push_back({ { "name", step.name }, { "cycles", step.cycles },
      { "residual", step.residual }, { "converged", step.converged } });
  }
  out["peak_nodes"] = this->peak_nodes;
  out["pool_bytes_peak"] = this->pool_bytes_peak;
  out["rss_bytes_peak"] = this->rss_bytes_peak;
  out["scratch_bytes_peak"] = this->scratch_bytes_peak;
  out["bytes_read"] = this->bytes_read;
  out["bytes_written"] = this->bytes_written;
  out["bytes_by_kind"] = nlohmann::ordered_json::array();
  for (const Traffic& traffic : this->bytes_by_kind)
  {
    auto& entry = out["bytes_by_kind"].emplace_back();
    entry["kind"] = traffic.kind;
    if (traffic.level >= 0)
    {
      entry["level"] = traffic.level;
    }
    entry["read"] = traffic.read;
    entry["written"] = traffic.written;
  }
  out["seconds"] = { { "convert", this->seconds.convert }, { "build", this->seconds.build },
    { "solve", this->seconds.solve }, { "coarse", this->seconds.coarse },
    { "io_wait", this->seconds.io_wait }, { "build_io_wait", this->seconds.build_io_wait },
    { "total", this->seconds.total } };
  out["cpu_seconds"] = this->cpu_seconds;
  out["threads"] = this->threads;
  out["prescribed"] = this->prescribed;
  // Of a deformation, the number of vertices that several handles hold.
  if (!this->steps.empty())
  {
    out["shared"] = this->shared;
  }
  out["held"] = this->held;
  out["degenerate_cells"] = this->degenerate_cells;
  out["coincident_cells"] = this->coincident_cells;
  out["clamped_weights"] = this->clamped_weights;
  out["components"] = this->components;
  out["free_components"] = this->free_components;
  if (!this->removed_source.empty())
  {
    out["removed_source"] = this->removed_source;
  }
  if (this->errors)
  {
    out["errors"] = { { "algebraic", this->errors->algebraic },
      { "discretisation", this->errors->discretisation },
      { "energy_norm", this->errors->energy_norm } };
  }
  // The results of the conditions exist only where they were evaluated (SolvedMesh::finish()).
  if (!this->mean.empty())
  {
    addResults(*this, out);
  }
  addJob(*this, out);
  out["notes"] = this->notes;
  out["warnings"] = this->warnings;
  return out.dump(indent);
}

std::string Report::residualText() const
{
  char number[32];
  std::snprintf(number, sizeof number, "%.3g", this->residual());
  return std::string("relative residual ") + number +
         (this->relative_to.empty() ? "" : ", to that of " + this->relative_to);
}

} // namespace smg
