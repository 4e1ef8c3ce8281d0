// SPDX-License-Identifier: BSD-3-Clause
// random_problems [--cases N] [--first SEED] [--keep FOLDER] [--file CASE]...
// Solves random problems and compares them with a direct solution (Check.h). A failure is shrunk
// and written to FOLDER as SEED.json, which --file repeats.
#include "Testing/Random/Check.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace
{

using smg::testing::Case;
using smg::testing::CheckedCase;

struct Tally
{
  int cases = 0, refused = 0, unconverged = 0, failed = 0;
  std::vector<double> errors;

  void add(const CheckedCase& checked)
  {
    ++this->cases;
    this->refused += checked.isRefused ? 1 : 0;
    this->unconverged += checked.hasConverged ? 0 : 1;
    this->failed += checked.failure.empty() ? 0 : 1;
    this->errors.push_back(checked.error);
  }

  void print()
  {
    std::ranges::sort(this->errors);
    const auto at = [this](double share)
    { return this->errors[static_cast<std::size_t>(share * (this->errors.size() - 1))]; };
    std::printf("%d cases: %d refused, %d not converged (and said so), %d failed; difference to "
                "the direct solution: median %.1e, 99 %% %.1e, largest %.1e\n",
      this->cases, this->refused, this->unconverged, this->failed, at(0.5), at(0.99), at(1));
  }
};

void report(const Case& failing, const std::string& failure, const std::string& folder)
{
  std::printf("seed %llu: %s\n", static_cast<unsigned long long>(failing.seed), failure.c_str());
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
  CLI::App app("Random problems against a direct solution");
  int cases = 300;
  std::uint64_t first = 1;
  std::string folder;
  std::vector<std::string> files;
  app.add_option("--cases", cases, "How many")->capture_default_str();
  app.add_option("--first", first, "The first seed")->capture_default_str();
  app.add_option("--keep", folder, "Folder for the shrunk failures");
  app.add_option("--file", files, "Cases to repeat instead");
  CLI11_PARSE(app, argc, argv);
  try
  {
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
