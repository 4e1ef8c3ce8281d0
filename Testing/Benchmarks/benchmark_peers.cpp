// SPDX-License-Identifier: BSD-3-Clause
// benchmark_peers MESH.vsm : solves one Poisson problem (FixedEndsProblem.h) with the streaming
// solver, with the same code in core, with conjugate gradients preconditioned by hypre's BoomerAMG
// and by PETSc's GAMG (where PETSc was found) and with CHOLMOD, each in a process of its own, and
// compares CPU time and memory.
//
//   benchmark_peers bunny.vsm --json bunny.json
//
// prints a Markdown table and writes the numbers. Everything runs on one thread unless --threads
// says otherwise for smg.

#include "Testing/Benchmarks/ChildProcess.h"
#include "Testing/Benchmarks/Output.h"
#include "Testing/Benchmarks/Peers.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::Task;

/** In the order of the table. */
const std::vector<std::pair<std::string, json (*)(const Task&)>> Peers = {
  { "smg", smg::benchmark::runStreaming },
  { "smg-in-core", smg::benchmark::runInCore },
  { "hypre", smg::benchmark::runHypre },
#ifdef SMG_BENCHMARK_PETSC
  { "petsc", smg::benchmark::runPetsc },
#endif
  { "cholmod", smg::benchmark::runCholmod },
};

std::vector<std::string> peerNames()
{
  std::vector<std::string> names;
  for (const auto& [name, run] : Peers)
  {
    names.push_back(name);
  }
  return names;
}

/** One peer's numbers, its solution checked by an independent assembly if `isChecked`. */
json measure(const std::string& peer, const Task& task, bool isChecked)
{
  const auto found = std::find_if(
    Peers.begin(), Peers.end(), [&](const auto& entry) { return entry.first == peer; });
  json result = smg::benchmark::runInChild([&] { return found->second(task); });
  if (isChecked && !result.contains("failed"))
  {
    result.update(smg::benchmark::runInChild([&] { return smg::benchmark::checkSolution(task); }));
  }
  std::filesystem::remove(task.solution);
  return result;
}

/** CPU microseconds per vertex, or a dash where the peer does not report them. */
std::string microseconds(const json& result, const char* key, std::int64_t vertices)
{
  if (!result.contains(key))
  {
    return "-";
  }
  return smg::benchmark::text(
    "%.2f", 1e6 * result[key].get<double>() / static_cast<double>(vertices));
}

void printTable(const std::vector<std::string>& peers, const json& results, std::int64_t vertices)
{
  std::cout << "| solver | CPU us/vertex: assemble | set up | solve | total | peak bytes/vertex | "
               "million vertices per GiB | iterations | relative residual |\n"
            << "|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& peer : peers)
  {
    const json& result = results[peer];
    if (result.contains("failed"))
    {
      std::cout << "| " << peer << " | failed: " << result["failed"].get<std::string>()
                << " | | | | | | | |\n";
      continue;
    }
    std::cout << "| " << peer;
    for (const char* key : { "cpu_assemble", "cpu_setup", "cpu_solve", "cpu_total" })
    {
      std::cout << " | " << microseconds(result, key, vertices);
    }
    const double bytes = result["peak_bytes"].get<double>() / static_cast<double>(vertices);
    std::cout << " | " << std::llround(bytes) << " | "
              << smg::benchmark::text("%.1f", static_cast<double>(1 << 30) / bytes / 1e6) << " | "
              << result["iterations"] << " | ";
    if (result.contains("relative_residual"))
    {
      std::cout << result["relative_residual"].get<double>();
    }
    std::cout << " |\n";
  }
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Compares the solver with hypre, PETSc and CHOLMOD on one mesh.");
  Task task;
  std::vector<std::string> names = peerNames();
  std::string jsonFile;
  bool isChecked = true;
  app.add_option("MESH", task.mesh, "A .vsm file")->required()->check(CLI::ExistingFile);
  app.add_option("--tolerance", task.tolerance, "Of the residual beside that of the best constant")
    ->capture_default_str();
  bool fromZero = false;
  app.add_flag("--from-zero", fromZero, "Initial values 0 instead of the positions");
  app.add_option("--threads", task.threads, "Of smg")->capture_default_str();
  app.add_option("--peers", names, "Which ones, separated by commas")
    ->delimiter(',')
    ->check(CLI::IsMember(peerNames()))
    ->capture_default_str();
  app.add_flag("--check,!--no-check", isChecked,
    "Whether to check each solution with a system assembled in core, which needs its memory");
  app.add_option("--json", jsonFile, "Where to write the numbers");
  CLI11_PARSE(app, argc, argv);
  using Start = smg::benchmark::FixedEndsProblem::Start;
  task.start = fromZero ? Start::Zero : Start::Positions;

  const smg::testing::TemporaryFolder folder;
  task.solution = folder / "solution";
  const smg::StreamInfo info = smg::VsmReader(task.mesh).info();
  json results = json::object();
  for (const std::string& name : names)
  {
    std::cerr << name << " ...\n";
    results[name] = measure(name, task, isChecked);
  }
  std::cout << task.mesh.filename().string() << ": " << info.vertices << " vertices, " << info.cells
            << " cells, 3 columns, from " << (fromZero ? "zero" : "the positions")
            << ", relative residual " << task.tolerance << "\n\n";
  printTable(names, results, info.vertices);
  smg::benchmark::writeNumbers(jsonFile,
    { { "mesh", task.mesh.string() }, { "vertices", info.vertices }, { "cells", info.cells },
      { "tolerance", task.tolerance }, { "start", fromZero ? "zero" : "positions" },
      { "threads", task.threads }, { "results", results } });
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_peers: " << error.what() << '\n';
  return 1;
}
