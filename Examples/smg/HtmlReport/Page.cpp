// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Page.h"

#include "HtmlReport/Resources.h"
#include "HtmlReport/Sections.h"
#include "HtmlReport/Text.h"

#include "IO/Jobs/Jobs.h"

#include <map>

namespace html
{

namespace
{

std::vector<std::string> CommandLine;

/** A figure of the headline; all texts are plain. */
std::string tile(const std::string& label, const std::string& value, const std::string& more)
{
  return "<div><dt>" + escape(label) + "</dt>\n<dd>" + escape(value) +
         (more.empty() ? "" : "\n<small>" + escape(more) + "</small>") + "</dd></div>\n";
}

/** What the command has done, before the name of its mesh. */
std::string deedOf(const std::string& command, bool isEstimate)
{
  std::map<std::string, std::string> deeds{ { "convert", "Conversion of" },
    { "preview", "Preview of" }, { "info", "Properties of" } };
  for (const smg::JobKind& kind : smg::jobKinds())
  {
    deeds.emplace(kind.name, kind.deed);
  }
  const auto found = deeds.find(command);
  return isEstimate ? "Expected costs: " + command : found == deeds.end() ? command : found->second;
}

std::string tiles(Entries& report, const PageFacts& facts)
{
  std::string out;
  const auto counts = [&](const char* name, const char* before)
  {
    if (const Json value = report.take(name); value.is_number())
    {
      const Json from = report.take(before);
      const bool isAbout = report.has("counted") && !report["counted"].get<bool>();
      out += tile(nameText(name), (isAbout ? "about " : "") + count(value.get<std::int64_t>()),
        from.is_number() ? "of " + count(from.get<std::int64_t>()) : "");
    }
  };
  counts("vertices", "vertices_before");
  counts("cells", "cells_before");
  counts("points", "");
  counts("triangles", "");
  if (report.has("residuals") && !report["residuals"].empty())
  {
    const Json& last = report["residuals"].back();
    const std::int64_t cycles = report.take("cycles").get<std::int64_t>();
    const std::int64_t passes = report.take("passes").get<std::int64_t>();
    const bool isDistributed = report.has("distributed");
    out += tile(isDistributed ? "iterations" : "V-cycles", count(cycles),
      isDistributed ? "" : "in " + counted(passes, "pass", "passes") + " over the mesh");
    const Json relative = report.take("relative_to");
    const std::string to = relative.is_string() ? "to that of " + relative.get<std::string>() : "";
    const std::string tolerance =
      facts.tolerance > 0.0 ? "tolerance " + number(facts.tolerance) : "";
    out += tile("relative residual",
      last.is_number() ? number(last.get<double>(), 3) : valueText("", last),
      to + (to.empty() || tolerance.empty() ? "" : ", ") + tolerance);
  }
  else if (const Json passes = report.take("passes"); passes.is_number())
  {
    out += tile("passes", count(passes.get<std::int64_t>()), "over the mesh");
  }
  if (report.has("seconds"))
  {
    const Json& seconds = report["seconds"];
    const double total = seconds.is_object() ? numberOf(seconds, "total") : seconds.get<double>();
    const double cpu = numberOf(report.rest(), "cpu_seconds");
    out += tile("time", html::seconds(total), cpu > 0.0 ? html::seconds(cpu) + " of CPU" : "");
  }
  if (const double pool = numberOf(report.rest(), "pool_bytes_peak"); pool > 0.0)
  {
    const auto limit = static_cast<double>(facts.memoryLimit);
    out += tile("memory", bytes(pool), limit > 0.0 ? "of at most " + bytes(limit) : "");
  }
  return "<dl class=\"tiles\">\n" + out + "</dl>\n";
}

std::string header(Entries& report, const PageFacts& facts, const std::string& title)
{
  std::string status;
  if (const Json converged = report.take("converged"); converged.is_boolean())
  {
    status = converged.get<bool>() ? "<p class=\"status good\">\u2713 Converged</p>\n"
                                   : "<p class=\"status bad\">\u2717 Not converged</p>\n";
  }
  return "<header>\n<p class=\"origin\">Streaming Multigrid " SMG_VERSION ", " + escape(now()) +
         "</p>\n<h1>" + escape(title) + "</h1>\n" + status + "<pre class=\"command\">" +
         escape(commandLine(CommandLine)) + "</pre>\n" + tiles(report, facts) + "</header>\n";
}

/** The surface with all that viewer.js needs; it shows the controls when it can draw. */
std::string resultSection(const ResultSurface& surface)
{
  if (!surface.failure.empty())
  {
    return section("result", "Result",
      "<p>The result is not drawn: " + escape(surface.failure) + "</p>\n", "wide");
  }
  const auto points = static_cast<std::int64_t>(surface.points());
  const bool isWhole = points >= surface.vertices;
  std::string caption = surface.isSolid ? "The outer surface of the tetrahedra" : "The surface";
  caption += isWhole ? ": " : ", simplified from " + count(surface.vertices) + " vertices: ";
  caption += counted(points, "point", "points") + " and " +
             counted(static_cast<std::int64_t>(surface.triangles()), "triangle", "triangles") +
             ". Drag or use the arrow keys to turn it, the wheel, two fingers or + and - to zoom, "
             "shift or the right button to move it.";
  return section("result", "Result",
    "<figure class=\"view\">\n<div class=\"stage\"><canvas tabindex=\"0\" role=\"img\" "
    "aria-label=\"The result in three dimensions\" hidden></canvas>\n"
    "<p class=\"absent\">The result is not drawn: that takes scripts and WebGL 2, and this browser "
    "lacks or forbids one of them.</p></div>\n"
    "<div class=\"controls\" hidden>\n<label>Colour <select name=\"column\"></select></label>\n"
    "<label>Up <select name=\"up\"><option>x</option><option>y</option><option>z</option>"
    "</select></label>\n<label><input type=\"checkbox\" name=\"contours\" checked> contour "
    "lines</label>\n"
    "<button type=\"button\">reset</button>\n"
    "<div class=\"bar\"><span class=\"least\"></span><span class=\"ramp\"></span>"
    "<span class=\"most\"></span></div>\n</div>\n<figcaption>" +
      escape(caption) +
      "</figcaption>\n</figure>\n<script type=\"application/json\" id=\"surface\">" +
      surface.json() + "</script>\n<script>\n" + ViewerScript + "</script>\n",
    "wide");
}

std::string foldedText(const std::string& summary, const char* id, const std::string& text)
{
  return "<details><summary>" + escape(summary) + "</summary><pre id=\"" + id + "\">" +
         escape(text) + "</pre></details>\n";
}

std::string sourcesSection(const std::string& json, const PageFacts& facts)
{
  std::string content;
  if (!facts.task.empty())
  {
    content = foldedText("The task: " + facts.taskFile.string(), "task", facts.task);
  }
  return section("sources", "As JSON", content + foldedText("This report", "report", json), "wide");
}

std::string head(const std::string& title)
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<meta name=\"generator\" content=\"smg " SMG_VERSION "\">\n"
         // Whatever a page holds, a browser loads nothing else for it.
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<title>" +
         escape(title) + "</title>\n<style>\n" + PageStyle + "</style>\n</head>\n";
}

} // namespace

void rememberCommandLine(int count, char** words)
{
  CommandLine.assign(words, words + count);
}

std::string page(const std::string& json, const PageFacts& facts)
{
  Entries report(Json::parse(json));
  const bool isEstimate = report.has("output_free");
  const std::string command = CommandLine.size() > 1 ? CommandLine[1] : "smg";
  const std::string title = deedOf(command, isEstimate) + ' ' + facts.in.filename().string();
  std::string out = head(title) + "<body>\n<main>\n" + header(report, facts, title);
  if (facts.surface)
  {
    out += resultSection(*facts.surface);
  }
  out += notesSection(report);
  out += isEstimate ? estimateSection(report) : "";
  out += solutionSection(report);
  out += convergenceSection(report, facts.tolerance);
  out += costSections(report, facts.memoryLimit);
  out += conditionsSection(report);
  out += integralsSection(report);
  out += levelsSection(report);
  out += furtherSection(report);
  return out + sourcesSection(json, facts) + "</main>\n</body>\n</html>\n";
}

} // namespace html
