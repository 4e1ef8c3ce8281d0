// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

/** What to take of a mesh file that is being converted. */
class InputOptions
{
public:
  /** Adds --cells, --weld, --time-step and --partition. */
  void addTo(CLI::App& command);

  /** Fills in what the options say. */
  void applyTo(smg::ConversionOptions& options) const;

  /** Throws smg::Error if `in` is a .vsm file, which is used as it is, and an option was given. */
  void checkIsConverted(const std::filesystem::path& in) const;

  bool welds() const { return this->Weld.has_value(); }

private:
  std::string Cells;
  std::optional<double> Weld;
  std::int64_t TimeStep = 0;
  std::optional<std::int64_t> Partition;
};
