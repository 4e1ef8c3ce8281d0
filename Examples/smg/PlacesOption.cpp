// SPDX-License-Identifier: BSD-3-Clause
#include "PlacesOption.h"

#include "smg/DescriptionFiles.h"

void PlacesOption::addTo(CLI::App& command, const std::string& what)
{
  command
    .add_option(this->Name, this->Given,
      what +
        ", as WHERE of a problem file: JSON, as '{\"sphere\": [0, 0, 0, 1]}', a list of these, or "
        "a file; may be given several times")
    ->check(
      [](const std::string& given) { return given.empty() ? "names no part of the mesh" : ""; })
    ->allow_extra_args(false)
    ->type_name("WHERE");
}

std::vector<smg::Where> PlacesOption::places() const
{
  std::vector<smg::Where> all;
  for (const std::string& given : this->Given)
  {
    const bool isJson = given.starts_with('{') || given.starts_with('[');
    const std::vector<smg::Where> places =
      isJson ? smg::readPlacesText(given, this->Name) : smg::readPlacesFile(given);
    all.insert(all.end(), places.begin(), places.end());
  }
  return all;
}
