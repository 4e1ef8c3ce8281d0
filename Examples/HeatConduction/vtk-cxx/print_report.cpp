// SPDX-License-Identifier: BSD-3-Clause
// A file without VTK: VTK 9.3 and later bundles a JSON library under the same names.
#include "print_report.h"

#include <nlohmann/json.hpp>

#include <iostream>

void printReport(const std::string& json)
{
  const auto report = nlohmann::json::parse(json);
  std::cout << report["vertices"] << " vertices, " << report["cells"] << " cells\n";
  std::cout << "peak: " << report["maximum"][0]["value"].get<double>() << " degrees at vertex "
            << report["maximum"][0]["vertex"] << " of the file\n";
  for (const auto& condition : report["conditions"])
  {
    std::cout << condition["name"].get<std::string>() << ": " << condition["flux"][0].get<double>()
              << " W into the body through " << 1e6 * condition["area"].get<double>() << " mm^2 of "
              << condition["mean"][0].get<double>() << " degrees\n";
  }
  std::cout << "relative imbalance of all flows: " << report["balance"][0].get<double>() << "\n";
}
