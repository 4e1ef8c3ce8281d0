// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Sections.h"

#include "HtmlReport/Charts.h"
#include "HtmlReport/Text.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

namespace html
{

Json Entries::take(const char* name)
{
  Json entry;
  if (const auto found = this->Rest.find(name); found != this->Rest.end())
  {
    entry = *found;
    this->Rest.erase(found);
  }
  return entry;
}

std::string section(
  const char* id, const std::string& title, const std::string& content, const char* style)
{
  return content.empty() ? ""
                         : "<section id=\"" + std::string(id) + "\" class=\"" + style + "\"><h2>" +
                             escape(title) + "</h2>\n" + content + "</section>\n";
}

namespace
{

/** The residuals by steps; without steps all of them. */
std::vector<ResidualChart::Step> stepsOf(const Json& steps, const Json& residuals)
{
  std::vector<double> all;
  for (const Json& residual : residuals)
  {
    all.push_back(
      residual.is_number() ? residual.get<double>() : std::numeric_limits<double>::quiet_NaN());
  }
  std::vector<ResidualChart::Step> split;
  auto begin = all.begin();
  for (const Json& step : steps)
  {
    const auto rest = all.end() - begin;
    const auto end = begin + std::min<std::ptrdiff_t>(rest, countOf(step, "cycles"));
    split.push_back({ step.value("name", ""), { begin, end } });
    begin = end;
  }
  if (begin != all.end())
  {
    split.push_back({ "", { begin, all.end() } });
  }
  return split;
}

} // namespace

std::string convergenceSection(Entries& report, double tolerance)
{
  if (!report.has("residuals"))
  {
    return {};
  }
  const Json residuals = report.take("residuals"), steps = report.take("steps");
  const std::string acceleration = report.has("acceleration")
                                     ? report.take("acceleration").get<std::string>()
                                     : std::string("none");
  if (residuals.empty() && report["levels"].empty())
  {
    return {}; // nothing is solved
  }
  std::string content;
  if (residuals.empty())
  {
    content = "<p>The initial values meet the tolerance: no V-cycle was needed.</p>\n";
  }
  else
  {
    const bool isDistributed = report.has("distributed");
    const auto iterations = static_cast<std::int64_t>(residuals.size());
    ResidualChart chart{ stepsOf(steps, residuals), isDistributed ? "iterations" : "V-cycles",
      tolerance, {} };
    chart.caption = "The relative residual after each of " +
                    (isDistributed ? counted(iterations, "iteration", "iterations")
                                   : counted(iterations, "V-cycle", "V-cycles")) +
                    (acceleration == "none"         ? std::string(", without acceleration.")
                      : acceleration == "cg"        ? ", accelerated by conjugate gradients."
                      : acceleration == "chebyshev" ? ", accelerated by Chebyshev polynomials."
                                                    : ", acceleration: " + acceleration + '.');
    content = figure(chart);
  }
  if (!steps.empty())
  {
    content += tableOf(steps);
  }
  return section("convergence", "Convergence", content);
}

std::string levelsSection(Entries& report)
{
  const Json levels = report.take("levels");
  if (levels.empty())
  {
    return {};
  }
  Table out{ { "level", "nodes", "nonzeros", "per row", "coarsening" }, {}, {} };
  double finer = 0.0;
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    const std::int64_t nodes = countOf(levels[l], "nodes");
    const std::int64_t nonzeros = countOf(levels[l], "nonzeros");
    const auto rows = static_cast<double>(nodes);
    char perRow[32] = "", ratio[32] = "";
    if (nodes > 0)
    {
      std::snprintf(perRow, sizeof perRow, "%.1f", static_cast<double>(nonzeros) / rows);
      std::snprintf(ratio, sizeof ratio, finer > 0.0 ? "%.1f : 1" : "", finer / rows);
    }
    out.rows.push_back({ std::to_string(l), count(nodes), count(nonzeros), perRow, ratio });
    finer = rows;
  }
  std::string content = table(out);
  if (const Json peak = report.take("peak_nodes"); peak.is_number())
  {
    content += "<p>At most " + count(peak.get<std::int64_t>()) +
               " nodes of all levels were in memory at once.</p>\n";
  }
  return section("levels", "Levels", content);
}

std::string conditionsSection(Entries& report)
{
  const Json conditions = report.take("conditions");
  if (conditions.empty())
  {
    return {};
  }
  Table out{ { "name", "vertices", "area", "mean", "flux" }, {} };
  for (const Json& condition : conditions)
  {
    // Only those of Dirichlet conditions are counted, and these need not have an area.
    const std::int64_t vertices = countOf(condition, "vertices");
    const double area = numberOf(condition, "area");
    out.rows.push_back({ condition.value("name", ""), vertices > 0 ? count(vertices) : "",
      area > 0.0 ? number(area) : "", valueText("mean", condition["mean"]),
      valueText("flux", condition["flux"]) });
  }
  return section("conditions", "Conditions",
    table(out) + "<p>Mean of the solution over the boundary of a condition, and flux into the body "
                 "through it.</p>\n");
}

std::string integralsSection(Entries& report)
{
  const Json integrals = report.take("integrals");
  if (integrals.empty())
  {
    return {};
  }
  Table out{ { "group", "measure", "integral", "mean", "gradient", "flux" }, {} };
  for (const Json& part : integrals)
  {
    std::vector<std::string>& row = out.rows.emplace_back();
    row = { part.value("name", ""), number(numberOf(part, "measure")) };
    for (const char* name : { "integral", "mean", "gradient", "flux" })
    {
      row.push_back(valueText(name, part[name]));
    }
  }
  return section("integrals", "Integrals",
    table(out) + "<p>Integral and mean of the solution over the cells of a group, and integrals of "
                 "grad u and of -K grad u.</p>\n");
}

namespace
{

/** What a quantity is, behind its name. */
constexpr struct
{
  const char* name;
  const char* meaning;
} OfSolution[] = { { "minimum", "smallest value, and its vertex" },
  { "maximum", "largest value, and its vertex" }, { "mean", "weighted with area or volume" },
  { "energy", "\u00bd \u222b grad u \u00b7 K grad u + s u\u00b2" }, { "source", "total of f" },
  { "screening", "total of s u" },
  { "balance", "inflow less outflow over the sum of all terms, of the size of the tolerance" } };

} // namespace

std::string solutionSection(Entries& report)
{
  Table out{ { "", "" }, {}, { true, true } };
  std::size_t columns = 0;
  for (const auto& [name, meaning] : OfSolution)
  {
    const Json values = report.take(name);
    if (values.empty())
    {
      continue;
    }
    std::vector<std::string>& row = out.rows.emplace_back();
    row = { name, meaning };
    for (const Json& value : values)
    {
      row.push_back(value.is_object() ? valueText("", value["value"]) + " at vertex " +
                                          count(countOf(value, "vertex"))
                                      : valueText("", value));
    }
    columns = std::max(columns, values.size());
  }
  if (out.rows.empty())
  {
    return {};
  }
  for (std::size_t i = 0; i < columns; ++i)
  {
    out.head.push_back(columns == 1 ? "value" : "column " + std::to_string(i));
  }
  return section("solution", "Solution", table(out), "wide");
}

std::string notesSection(Entries& report)
{
  const Json notes = report.take("notes");
  const Json warnings = report.take("warnings");
  std::string list;
  for (const Json& note : notes)
  {
    const bool isWarning = std::ranges::count(warnings, note) > 0;
    list += (isWarning ? "<li><strong>Warning:</strong> " : "<li>") +
            escape(note.is_string() ? note.get<std::string>() : note.dump()) + "</li>\n";
  }
  return section("notes", "Notes", list.empty() ? "" : "<ul>\n" + list + "</ul>\n", "wide");
}

std::string furtherSection(const Entries& report)
{
  return section("figures", "Further figures", furtherFigures(report.rest()));
}

} // namespace html
