// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/FilterDoor.h"

#include "Testing/Random/Doors.h"
#include "Testing/Support/TemporaryFolder.h"

#include <nlohmann/json.hpp>

namespace smg::testing
{

Result solveFilter(const Case& given)
{
  const TemporaryFolder folder;
  const CaseRun& run = given.run;
  // The filter refuses fluxes where a cell does not know its conductivity by itself.
  nlohmann::json problem = given.problem;
  problem.erase("outputs");
  FilterResult result = solveByFilter({ convertedFile(given, folder.path()), folder.path(),
    problem.dump(), given.vertices(), given.problem.value("columns", 1), run.pieces, run.threads,
    run.sweeps, run.acceleration, run.inCore });
  const auto json = nlohmann::json::parse(result.report);
  Result found{ std::move(result.values), {} };
  found.report.converged = json.at("converged");
  found.report.acceleration = json.at("acceleration");
  found.report.notes = json.at("notes").get<std::vector<std::string>>();
  return found;
}

} // namespace smg::testing
