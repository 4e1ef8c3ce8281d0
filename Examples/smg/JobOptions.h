// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"

#include "IO/Formats/UsedFiles.h"
#include "IO/Jobs/JobOption.h"

#include <CLI/CLI.hpp>

#include <deque>
#include <string>
#include <string_view>
#include <vector>

/** The options of the table of a job (IO/Jobs/JobOption.h) as options of its command, except for
 * descriptions and those that all commands have. */
class JobOptions
{
public:
  /** Adds the options. `job` is made anew, and is set as they are parsed, but for what files say.
   */
  void addTo(CLI::App& command, smg::Job& job);

  /** Whether the option with this key was given. */
  bool isGiven(std::string_view key) const;
  /** Sets the options that were given, whatever the job has been set to since. Throws smg::Error,
   * which names the option or the file. */
  void apply(smg::Job& job) const;
  /** Adds the files that stand for WHERE. */
  void addFiles(smg::UsedFiles& files) const;

private:
  struct Entry
  {
    const smg::JobOption* option;
    std::string name;               ///< with --
    std::vector<std::string> texts; ///< as they were given
  };

  std::deque<Entry> Entries; ///< at fixed addresses, which the parser has
};
