// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HtmlReport/Figures.h"

#include <cstdint>
#include <string>
#include <utility>

namespace html
{

/** A report, from which the sections of the page take what they show. What none of them knows is
 * shown as further figures, so that no entry of a report is missing on its page. */
class Entries
{
public:
  explicit Entries(Json report)
    : Rest(std::move(report))
  {
  }

  bool has(const char* name) const { return this->Rest.contains(name); }
  const Json& operator[](const char* name) const { return this->Rest.at(name); }
  /** Removes an entry and returns it; null if there is none. */
  Json take(const char* name);
  const Json& rest() const { return this->Rest; }

private:
  Json Rest;
};

// Each returns a section, or nothing where the report has no such entries.

/** Residuals and steps; `tolerance` is 0 where none was asked for. */
std::string convergenceSection(Entries& report, double tolerance);
/** Memory against its limit (0: not known), time by phase, traffic of scratch files. */
std::string costSections(Entries& report, std::int64_t memoryLimit);
/** What a command is expected to cost: see smg::JobEstimate. */
std::string estimateSection(Entries& report);
std::string levelsSection(Entries& report);
std::string conditionsSection(Entries& report);
std::string integralsSection(Entries& report);
/** Integrals and extremes of a solution, by its columns. */
std::string solutionSection(Entries& report);
std::string notesSection(Entries& report);
std::string furtherSection(const Entries& report);

/** A section with a heading; `content` is HTML. */
std::string section(
  const char* id, const std::string& title, const std::string& content, const char* style = "");

} // namespace html
