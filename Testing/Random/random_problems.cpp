// SPDX-License-Identifier: BSD-3-Clause
// random_problems [--cases N] [--first SEED] [--job JOB] [--door DOOR] [--keep FOLDER] [--file
// CASE]... Runs random cases and compares them with an oracle (Check.h). A failure is shrunk and
// written to FOLDER as SEED.json, which --file repeats.
#include "Testing/Random/Check.h"
#include "Testing/Random/Doors.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using smg::testing::Case;
using smg::testing::CheckedCase;

struct Tally
{
  int cases = 0, refused = 0, outOfMemory = 0, unconverged = 0, approximate = 0, failed = 0;
  std::vector<double> errors;

  void add(const CheckedCase& checked)
  {
    ++this->cases;
    this->refused += checked.isRefused ? 1 : 0;
    this->outOfMemory += checked.isOutOfMemory ? 1 : 0;
    this->unconverged += checked.hasConverged ? 0 : 1;
    this->approximate += checked.isApproximate ? 1 : 0;
    this->failed += checked.failure.empty() ? 0 : 1;
    this->errors.push_back(checked.isApproximate ? 0.0 : checked.error);
  }

  void print()
  {
    if (this->errors.empty())
    {
      throw std::runtime_error("none of the cases is of this job and door");
    }
    std::ranges::sort(this->errors);
    const auto at = [this](double share)
    { return this->errors[static_cast<std::size_t>(share * (this->errors.size() - 1))]; };
    std::printf("%d cases: %d refused, %d beyond their memory limit, %d not converged and %d with "
                "cells too flat (and said so), %d failed; difference to the oracle: median %.1e, "
                "99 %% %.1e, largest %.1e\n",
      this->cases, this->refused, this->outOfMemory, this->unconverged, this->approximate,
      this->failed, at(0.5), at(0.99), at(1));
  }
};

void report(const Case& failing, const std::string& failure, const std::string& folder)
{
  std::printf("seed %llu, %s: %s\n", static_cast<unsigned long long>(failing.seed),
    failing.job.c_str(), failure.c_str());
  std::fflush(stdout);
  const Case small = shrink(failing);
  std::printf("  shrunk to %lld cells: %s\n  problem %s\n", static_cast<long long>(small.cells()),
    check(small).failure.c_str(), small.problem.dump().c_str());
  if (!folder.empty())
  {
    std::filesystem::create_directories(folder);
    const auto path = std::filesystem::path(folder) / (std::to_string(failing.seed) + ".json");
    small.save(path);
    std::printf("  kept as %s\n", path.c_str());
  }
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("Random problems against an oracle");
  int cases = 300;
  std::uint64_t first = 1;
  std::string folder, job, door;
  std::vector<std::string> files, killed;
  app.add_option("--cases", cases, "How many")->capture_default_str();
  app.add_option("--first", first, "The first seed")->capture_default_str();
  app.add_option("--keep", folder, "Folder for the shrunk failures");
  app.add_option("--file", files, "Cases to repeat instead");
  app.add_option("--job", job, "Only cases of this job");
  app.add_option("--door", door, "Only solves by this door: c++, file or vtk");
  app.add_option("--killed", killed, "Solves a case with a checkpoint until it kills itself")
    ->expected(2);
  CLI11_PARSE(app, argc, argv);
  try
  {
    if (!killed.empty())
    {
      smg::testing::solveUntilKilled(Case::load(killed[0]), killed[1]);
      return 0;
    }
    Tally tally;
    for (const std::string& file : files)
    {
      const Case given = Case::load(file);
      const CheckedCase checked = check(given);
      tally.add(checked);
      std::printf(
        "%s: %s\n", file.c_str(), checked.failure.empty() ? "ok" : checked.failure.c_str());
    }
    for (int k = 0; files.empty() && k < cases; ++k)
    {
      const Case given = smg::testing::randomCase(first + static_cast<std::uint64_t>(k));
      if ((!job.empty() && given.job != job) ||
          (!door.empty() && (given.run.door != door || given.job != "solve")))
      {
        continue;
      }
      const CheckedCase checked = check(given);
      tally.add(checked);
      if (!checked.failure.empty())
      {
        report(given, checked.failure, folder);
      }
    }
    tally.print();
    return tally.failed == 0 ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "random_problems: %s\n", error.what());
    return 2;
  }
}
