// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Fields.h"
#include "smg/Export.h"
#include "smg/Report.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

// The entries of a report. A new figure is a member of Report and its line here.

namespace smg
{

template <>
inline constexpr auto Fields<Report::Level> = std::tuple{
  field("nodes", &Report::Level::nodes),
  field("nonzeros", &Report::Level::nonzeros),
  field("window", &Report::Level::window),
};

template <>
inline constexpr auto Fields<Report::Stage> = std::tuple{
  field("name", &Report::Stage::name),
  field("level", &Report::Stage::level),
  field("first", &Report::Stage::first),
  field("seconds", &Report::Stage::seconds),
};

template <>
inline constexpr auto Fields<Report::Seconds> = std::tuple{
  field("convert", &Report::Seconds::convert, total::Sum),
  field("build", &Report::Seconds::build, total::Sum),
  field("solve", &Report::Seconds::solve, total::Sum),
  field("coarse", &Report::Seconds::coarse, total::Sum),
  field("io_wait", &Report::Seconds::io_wait, total::Sum),
  field("build_io_wait", &Report::Seconds::build_io_wait, total::Sum),
  field("total", &Report::Seconds::total, total::Sum),
};

template <>
inline constexpr auto Fields<Report::Traffic> = std::tuple{
  field("kind", &Report::Traffic::kind),
  field("level", &Report::Traffic::level, total::None,
    [](const Report::Traffic&, int level) { return level >= 0; }),
  field("read", &Report::Traffic::read, total::Sum),
  field("written", &Report::Traffic::written, total::Sum),
};

template <>
inline constexpr auto Fields<Report::Pass> = std::tuple{
  field("residual", &Report::Pass::residual),
  field("seconds", &Report::Pass::seconds),
  field("read", &Report::Pass::read),
  field("written", &Report::Pass::written),
  field("pool_bytes", &Report::Pass::pool_bytes),
};

template <>
inline constexpr auto Fields<Report::Step> = std::tuple{
  field("name", &Report::Step::name),
  field("cycles", &Report::Step::cycles),
  field("residual", &Report::Step::residual),
  field("converged", &Report::Step::converged),
};

template <>
inline constexpr auto Fields<Report::Volume> = std::tuple{
  field("before", &Report::Volume::before),
  field("after", &Report::Volume::after),
  field("swept", &Report::Volume::swept),
};

template <>
inline constexpr auto Fields<Report::Path> = std::tuple{
  field("to", &Report::Path::to),
  field("from", &Report::Path::from),
  field("length", &Report::Path::length),
  field("points", &Report::Path::points),
};

template <>
inline constexpr auto Fields<Report::Distance> = std::tuple{
  field("exact", &Report::Distance::exact),
  field("sources", &Report::Distance::sources),
  field("unreached", &Report::Distance::unreached),
  field("unsettled", &Report::Distance::unsettled),
  field("mesh_readings", &Report::Distance::mesh_readings),
  field("maximum", &Report::Distance::maximum),
  field("mean", &Report::Distance::mean),
  field("paths", &Report::Distance::paths, total::None, shown::IfAny),
};

template <>
inline constexpr auto Fields<Report::Area> = std::tuple{
  field("tag", &Report::Area::tag),
  field("cells", &Report::Area::cells),
  field("area", &Report::Area::area),
};

template <>
inline constexpr auto Fields<Report::Areas> = std::tuple{
  field("isVolume", &Report::Areas::isVolume),
  field("cells", &Report::Areas::cells),
  field("total", &Report::Areas::total),
  field("hasTags", &Report::Areas::hasTags),
  field("by_tag", &Report::Areas::by_tag),
};

template <>
inline constexpr auto Fields<Report::Inverted> = std::tuple{
  field("cells", &Report::Inverted::cells),
  field("share", &Report::Inverted::share),
  field("worst", &Report::Inverted::worst),
  field("ratio", &Report::Inverted::ratio),
  field("place", &Report::Inverted::place),
};

template <>
inline constexpr auto Fields<Report::Errors> = std::tuple{
  field("algebraic", &Report::Errors::algebraic),
  field("discretisation", &Report::Errors::discretisation),
  field("energy_norm", &Report::Errors::energy_norm),
};

template <>
inline constexpr auto Fields<Report::Distributed> = std::tuple{
  field("processes", &Report::Distributed::processes),
  field("setups", &Report::Distributed::setups),
  field("iterations", &Report::Distributed::iterations),
  field("pool_bytes_peak", &Report::Distributed::pool_bytes_peak),
  field("rss_bytes_peak", &Report::Distributed::rss_bytes_peak),
};

template <>
inline constexpr auto Fields<Report::Condition> = std::tuple{
  field("name", &Report::Condition::name),
  field("vertices", &Report::Condition::vertices),
  field("area", &Report::Condition::area),
  field("mean", &Report::Condition::mean),
  field("flux", &Report::Condition::flux),
};

template <>
inline constexpr auto Fields<Report::Part> = std::tuple{
  field("name", &Report::Part::name),
  field("measure", &Report::Part::measure),
  field("gradient", &Report::Part::gradient),
  field("flux", &Report::Part::flux),
};

template <>
inline constexpr auto Fields<Report::Integral> = std::tuple{
  field("name", &Report::Integral::name),
  field("measure", &Report::Integral::measure),
  field("integral", &Report::Integral::integral),
  field("mean", &Report::Integral::mean),
  field("gradient", &Report::Integral::gradient),
  field("flux", &Report::Integral::flux),
};

template <>
inline constexpr auto Fields<Report::Contact> = std::tuple{
  field("name", &Report::Contact::name),
  field("area", &Report::Contact::area),
  field("step", &Report::Contact::step),
  field("flow", &Report::Contact::flow),
};

template <>
inline constexpr auto Fields<Report::Seam> = std::tuple{
  field("column", &Report::Seam::column),
  field("before", &Report::Seam::before),
  field("after", &Report::Seam::after),
};

template <>
inline constexpr auto Fields<Report::Extreme> = std::tuple{
  field("value", &Report::Extreme::value),
  field("vertex", &Report::Extreme::vertex),
};

namespace shown
{
/** Results exist only where they were evaluated (SolvedMesh::finish()); lists of them are there
 * even if they are empty, so that a script may loop over them without a test. */
inline constexpr auto OfSolution = [](const Report& report, const auto&)
{ return !report.mean.empty(); };
inline constexpr auto OfParts = [](const Report& report, const std::vector<Report::Part>& parts)
{ return !report.mean.empty() && !parts.empty(); };
inline constexpr auto OfSteps = [](const Report& report, std::int64_t)
{ return !report.steps.empty(); };
inline constexpr auto OfSeams = [](const Report& report, std::int64_t)
{ return !report.seams.empty(); };
} // namespace shown

namespace total
{
/** Of each kind and level. */
inline constexpr auto OfKinds =
  [](std::vector<Report::Traffic>& all, const std::vector<Report::Traffic>& next)
{
  for (const Report::Traffic& more : next)
  {
    const auto same = std::ranges::find_if(all,
      [&more](const Report::Traffic& t) { return t.kind == more.kind && t.level == more.level; });
    same == all.end() ? all.push_back(more) : addFields(*same, more);
  }
};
} // namespace total

template <>
inline constexpr auto Fields<Report> = std::tuple{
  field("vertices", &Report::vertices, total::Last),
  field("cells", &Report::cells, total::Last),
  field("levels", &Report::levels, total::Last),
  field("passes", &Report::passes, total::Sum),
  field("resumed_passes", &Report::resumed_passes),
  field("cycles", &Report::cycles, total::Sum),
  field("residuals", &Report::residuals, total::Joined),
  field("relative_to", &Report::relative_to, total::Last, shown::IfAny),
  field("by_pass", &Report::by_pass, total::Joined, shown::IfAny),
  field("stages", &Report::stages, total::None, shown::IfAny),
  field("acceleration", &Report::acceleration, total::Last),
  field("converged", &Report::converged, total::All),
  field("steps", &Report::steps, total::None, shown::IfAny),
  field("peak_nodes", &Report::peak_nodes, total::Largest),
  field("pool_bytes_peak", &Report::pool_bytes_peak, total::Largest),
  field("rss_bytes_peak", &Report::rss_bytes_peak, total::Largest),
  field("scratch_bytes_peak", &Report::scratch_bytes_peak, total::Largest),
  field("bytes_read", &Report::bytes_read, total::Sum),
  field("bytes_written", &Report::bytes_written, total::Sum),
  field("bytes_by_kind", &Report::bytes_by_kind, total::OfKinds),
  field("seconds", &Report::seconds, total::Each),
  field("cpu_seconds", &Report::cpu_seconds, total::Sum),
  field("threads", &Report::threads, total::Last),
  field("prescribed", &Report::prescribed, total::Last),
  field("shared", &Report::shared, total::None, shown::OfSteps),
  field("held", &Report::held, total::Last),
  field("degenerate_cells", &Report::degenerate_cells, total::Last),
  field("coincident_cells", &Report::coincident_cells, total::Last),
  field("clamped_weights", &Report::clamped_weights, total::Last),
  field("components", &Report::components, total::Last),
  field("free_components", &Report::free_components, total::Last),
  field("removed_source", &Report::removed_source, total::None, shown::IfAny),
  field("errors", &Report::errors, total::None, shown::IfAny),
  field("conditions", &Report::conditions, total::None, shown::OfSolution),
  field("parts", &Report::parts, total::None, shown::OfParts),
  field("contacts", &Report::contacts, total::None, shown::IfAny),
  field("integrals", &Report::integrals, total::None, shown::IfAny),
  field("energy", &Report::energy, total::None, shown::OfSolution),
  field("mean", &Report::mean, total::None, shown::OfSolution),
  field("minimum", &Report::minimum, total::None, shown::OfSolution),
  field("maximum", &Report::maximum, total::None, shown::OfSolution),
  field("source", &Report::source, total::None, shown::OfSolution),
  field("screening", &Report::screening, total::None, shown::OfSolution),
  field("balance", &Report::balance, total::None, shown::OfSolution),
  field("volume", &Report::volume, total::None, shown::IfAny),
  field("seams", &Report::seams, total::None, shown::IfAny),
  field("clipped", &Report::clipped, total::None, shown::OfSeams),
  field("areas", &Report::areas, total::None, shown::IfAny),
  field("distance", &Report::distance, total::None, shown::IfAny),
  field("inverted", &Report::inverted, total::None, shown::IfAny),
  field("distributed", &Report::distributed, total::None, shown::IfAny),
  field("notes", &Report::notes, total::Distinct),
  field("warnings", &Report::warnings, total::Distinct),
};

/** A report with all of its figures as bytes, for other processes. */
SMG_EXPORT std::vector<std::uint8_t> packedReport(const Report& report);
SMG_EXPORT Report unpackedReport(std::span<const std::uint8_t> bytes);

} // namespace smg
