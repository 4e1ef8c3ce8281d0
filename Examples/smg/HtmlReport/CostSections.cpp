// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Charts.h"
#include "HtmlReport/Sections.h"
#include "HtmlReport/Text.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace html
{

namespace
{

Bar bytesBar(std::string label, double length)
{
  return { std::move(label), bytes(length), length };
}

std::string memorySection(Entries& report, std::int64_t memoryLimit)
{
  BarChart chart{ "Memory", {}, static_cast<double>(memoryLimit),
    "limit " + bytes(static_cast<double>(memoryLimit)), {} };
  const std::pair<const char*, const char*> kinds[] = { { "pool_bytes_peak", "accounted, at most" },
    { "rss_bytes_peak", "resident memory of the process, at most" } };
  for (const auto& [name, label] : kinds)
  {
    if (const Json peak = report.take(name); peak.is_number() && peak.get<double>() > 0.0)
    {
      chart.bars.push_back(bytesBar(label, peak.get<double>()));
    }
  }
  if (chart.bars.empty())
  {
    return {};
  }
  chart.caption = memoryLimit > 0
                    ? "The limit holds for the accounted memory: the windows of all levels, the "
                      "blocks of files and what is kept in memory as a whole. The process has its "
                      "program code and libraries besides."
                    : "Accounted are windows, blocks of files and what is kept in memory as a "
                      "whole; the process has its program code and libraries besides.";
  return section("memory", "Memory", figure(chart));
}

/** What each pass left and cost. */
std::string passesTable(Entries& report)
{
  const Json passes = report.take("by_pass");
  if (!passes.is_array() || passes.empty())
  {
    return {};
  }
  Table rows{ { "pass", "residual", "time", "read", "written", "accounted memory so far" }, {} };
  for (const Json& pass : passes)
  {
    rows.rows.push_back(
      { std::to_string(rows.rows.size() + 1), valueText("residual", pass.value("residual", Json())),
        html::seconds(numberOf(pass, "seconds")), bytes(numberOf(pass, "read")),
        bytes(numberOf(pass, "written")), bytes(numberOf(pass, "pool_bytes")) });
  }
  return "<details><summary>By pass</summary>" + table(rows) + "</details>\n";
}

/** The phases of a report, with the rest up to the total. */
std::string timeSection(Entries& report)
{
  const Json given = report.take("seconds");
  const Json seconds = given.is_number() ? Json{ { "total", given } } : given;
  if (!seconds.is_object())
  {
    return {};
  }
  const std::pair<const char*, const char*> known[] = { { "convert", "conversion of the mesh" },
    { "build", "first pass: assembly, hierarchy" }, { "solve", "all further passes" },
    { "coarse", "in the passes: levels in memory" },
    { "io_wait", "in the passes: waits for scratch files" },
    { "build_io_wait", "in the first one: waits for scratch files" }, { "import", "reading" },
    { "order", "ordering" }, { "write", "writing" } };
  BarChart chart{ "Time by phase", {}, 0.0, {}, {} };
  const double total = numberOf(seconds, "total");
  double rest = total;
  std::vector<Bar> parts;
  for (const auto& [name, value] : seconds.items())
  {
    const double time = numberOf(seconds, name.c_str());
    if (name == "total" || time <= 0.0)
    {
      continue;
    }
    const auto* const label =
      std::ranges::find(known, name, &std::pair<const char*, const char*>::first);
    const bool isPart = name == "coarse" || name.ends_with("io_wait");
    Bar bar{ label == std::end(known) ? nameText(name) : label->second, html::seconds(time), time,
      0.0, isPart };
    rest -= isPart ? 0.0 : time;
    (isPart ? parts : chart.bars).push_back(std::move(bar));
  }
  if (!chart.bars.empty() && rest > 0.005 * total)
  {
    const bool isSolve = numberOf(seconds, "build") > 0.0;
    chart.bars.push_back(
      { isSolve ? "results, writing, picture of this page" : "rest", html::seconds(rest), rest });
  }
  chart.bars.insert(chart.bars.end(), parts.begin(), parts.end());
  if (chart.bars.empty())
  {
    chart.bars.push_back({ "total", html::seconds(total), total });
  }
  const Json cpu = report.take("cpu_seconds"), threads = report.take("threads");
  chart.caption = "Wall-clock time, " + html::seconds(total) + " in all";
  if (cpu.is_number())
  {
    chart.caption += "; " + html::seconds(cpu.get<double>()) + " of processor time";
  }
  if (threads.is_number())
  {
    chart.caption += " on " + counted(threads.get<std::int64_t>(), "thread", "threads");
  }
  chart.caption += '.';
  return section("time", "Time", figure(chart) + passesTable(report));
}

/** Traffic by kinds, and the table with their levels. */
std::string trafficSection(Entries& report)
{
  const Json kinds = report.take("bytes_by_kind");
  const double read = numberOf(report.rest(), "bytes_read");
  const double written = numberOf(report.rest(), "bytes_written");
  report.take("bytes_read");
  report.take("bytes_written");
  if (kinds.empty() || read + written <= 0.0)
  {
    return {};
  }
  std::vector<std::pair<std::string, Bar>> sums;
  for (const Json& kind : kinds)
  {
    const std::string name = kind.value("kind", "");
    auto sum = std::ranges::find(sums, name, &std::pair<std::string, Bar>::first);
    if (sum == sums.end())
    {
      sum = sums.insert(sum, { name, { nameText(name), {} } });
    }
    sum->second.length += numberOf(kind, "read");
    sum->second.second += numberOf(kind, "written");
  }
  BarChart chart{ "Traffic of scratch files", {}, 0.0, {}, {}, { "read", "written" } };
  for (auto& [name, bar] : sums)
  {
    bar.value = bytes(bar.length) + " + " + bytes(bar.second);
    chart.bars.push_back(bar);
  }
  chart.caption = bytes(read) + " read and " + bytes(written) + " written in all";
  if (const Json peak = report.take("scratch_bytes_peak"); peak.is_number())
  {
    chart.caption += ", " + bytes(peak.get<double>()) + " on disk at most";
  }
  chart.caption += '.';
  Table levels{ { "kind", "level", "read", "written" }, {} };
  for (const Json& kind : kinds)
  {
    levels.rows.push_back({ nameText(kind.value("kind", "")),
      kind.contains("level") ? std::to_string(countOf(kind, "level")) : "",
      bytes(numberOf(kind, "read")), bytes(numberOf(kind, "written")) });
  }
  return section("traffic", "Scratch files",
    figure(chart) + "<details><summary>By level</summary>" + table(levels) + "</details>\n");
}

} // namespace

std::string costSections(Entries& report, std::int64_t memoryLimit)
{
  std::string all = memorySection(report, memoryLimit);
  all += timeSection(report);
  return all + trafficSection(report);
}

std::string estimateSection(Entries& report)
{
  const auto pair = [&](const char* title, const char* name, const char* roomName, const char* room)
  {
    const double need = numberOf(report.rest(), name), has = numberOf(report.rest(), roomName);
    BarChart chart{ title, { { title, "about " + bytes(need), need } }, 0.0, {}, {} };
    if (has > 0.0)
    {
      chart.limit = has;
      chart.limitText = std::string(room) + ' ' + bytes(has);
      chart.caption = need > has ? "More than there is room for." : "";
    }
    report.take(name);
    report.take(roomName);
    return figure(chart);
  };
  std::string content = pair("memory", "memory_bytes", "memory_limit", "limit");
  content += pair("scratch files", "scratch_bytes", "scratch_free", "free on their disk");
  content += pair("result", "output_bytes", "output_free", "free on its disk");
  return section("estimate", "Expected costs", content);
}

} // namespace html
