// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Region.h"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

/** An option that names parts of the mesh in JSON, and may be given several times. */
class PlacesOption
{
public:
  /** `name` is the name of the option, for example "--hold". */
  explicit PlacesOption(std::string name)
    : Name(std::move(name))
  {
  }

  /** Adds the option. `what` is what it names, for example "A part of the mesh that does not move".
   */
  void addTo(CLI::App& command, const std::string& what);

  /** The values given: JSON or names of files. */
  const std::vector<std::string>& given() const { return this->Given; }
  /** The parts of all options. Throws smg::Error. */
  std::vector<smg::Where> places() const;

private:
  std::string Name;
  std::vector<std::string> Given;
};
