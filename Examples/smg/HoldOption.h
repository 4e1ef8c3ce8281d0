// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Region.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

/** The option --hold: parts of the mesh, in JSON. */
class HoldOption
{
public:
  /** Adds the option. `what` says what is held, for example "does not move". */
  void addTo(CLI::App& command, const std::string& what);

  /** The parts of all options. Throws smg::Error. */
  std::vector<smg::Where> places() const;

private:
  std::vector<std::string> Given;
};
