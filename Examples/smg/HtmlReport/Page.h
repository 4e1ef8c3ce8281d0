// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HtmlReport/ResultSurface.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace html
{

/** What a page says besides the report of its command. */
struct PageFacts
{
  std::filesystem::path in;            ///< the mesh
  std::int64_t memoryLimit = 0;        ///< bytes; 0: the report has it, or it is not known
  double tolerance = 0.0;              ///< of the relative residual; 0: none
  std::string task = {};               ///< what was to be done, in JSON; empty: the command line
  std::filesystem::path taskFile = {}; ///< where that was read
  std::optional<ResultSurface> surface = {}; ///< what is drawn
};

/** The words of the command line, for all pages of the process. */
void rememberCommandLine(int count, char** words);

/**
 * A report as one HTML page for a person: figures, tables and the result in space. It needs nothing
 * but itself: no file, no network; and without scripts all of it can be read but the picture of the
 * result.
 *
 * @param json the report, an object. Entries with a known name have a place of their own, all
 * others are listed, and the report itself is at the end of the page.
 */
std::string page(const std::string& json, const PageFacts& facts);

} // namespace html
