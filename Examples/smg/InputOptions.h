// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

/** Options of the conversion of the input. */
class InputOptions
{
public:
  /** Adds --cells, --weld, --time-step and --partition. */
  void addTo(CLI::App& command);

  /** Applies the options. */
  void applyTo(smg::ConversionOptions& options) const;

  bool welds() const { return this->Weld.has_value(); }

private:
  std::string Cells;
  std::optional<double> Weld;
  std::int64_t TimeStep = 0;
  std::optional<std::int64_t> Partition;
};
