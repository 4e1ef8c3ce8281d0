// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace smg::testing
{

/** A reader of files, and what uses it, that receives arbitrary bytes. */
struct FuzzTarget
{
  std::string name; ///< also that of the folder of its corpus
  /** Returns whether the bytes were accepted; otherwise they were refused with an Error that names
   * the file. Throws Finding, or anything but Error, if the reader has a defect. */
  std::function<bool(std::string_view bytes, CellChoice cells)> run;
  bool solves = false; ///< a run takes some milliseconds: tests have fewer of them
};

/** All of them: also one for each format with a parser. */
std::span<const FuzzTarget> fuzzTargets();

/** The target of that name. Throws std::invalid_argument if there is none. */
const FuzzTarget& fuzzTarget(std::string_view name);

/** The choice of cells for these bytes: every choice occurs for some lengths. */
CellChoice choiceFor(std::string_view bytes);

} // namespace smg::testing
