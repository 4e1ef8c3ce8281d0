// SPDX-License-Identifier: BSD-3-Clause
// benchmark_table3 MESH.vsm... : Table 3 of the paper "Out-of-Core Multigrid Solver for Streaming
// Meshes" for our meshes: each solved out of core and in core (FixedEndsProblem.h), each solve in a
// process of its own, and where its wall time goes.
//
//   benchmark_table3 bunny.vsm dragon.vsm --json table3.json
//
// prints a Markdown table and writes the numbers. As in the paper the times are wall times and add
// up to the total: I/O is the reading of the mesh and the waiting for scratch files, H.C.
// (hierarchy construction) the rest of the first pass, M.O. (multigrid operations) the rest of the
// V-cycles. Unlike in the paper the first pass also relaxes and restricts. Scratch files go to
// TMPDIR.

#include "Testing/Benchmarks/ChildProcess.h"
#include "Testing/Benchmarks/Output.h"
#include "Testing/Benchmarks/Peers.h"
#include "Testing/Support/TemporaryFolder.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::Task;
using smg::benchmark::text;

/** A row of the table. */
json measure(const Task& task, bool inCore)
{
  const json result = smg::benchmark::runInChild(
    [&] { return inCore ? smg::benchmark::runInCore(task) : smg::benchmark::runStreaming(task); });
  std::filesystem::remove(task.solution);
  json row = { { "mesh", task.mesh.stem().string() },
    { "solver", inCore ? "in core" : "streaming" } };
  if (result.contains("failed"))
  {
    row["failed"] = result["failed"];
    return row;
  }
  const json& report = result["report"];
  const json& seconds = report["seconds"];
  const double reading = result["mesh_seconds"];
  const double waiting = seconds["io_wait"];
  const double waitingInBuild = seconds["build_io_wait"];
  const double total = seconds["total"];
  const double hierarchy = seconds["build"].get<double>() - reading - waitingInBuild;
  row.update({ { "vertices", report["vertices"] }, { "levels", report["levels"].size() },
    { "io_seconds", reading + waiting }, { "hierarchy_seconds", hierarchy },
    { "multigrid_seconds", total - reading - waiting - hierarchy }, { "total_seconds", total },
    { "cpu_seconds", report["cpu_seconds"] }, { "cycles", report["cycles"] },
    { "converged", report["converged"] }, { "peak_nodes", report["peak_nodes"] },
    { "pool_bytes", report["pool_bytes_peak"] }, { "process_bytes", result["peak_bytes"] } });
  return row;
}

void printRow(const json& row)
{
  std::cout << "| " << row["mesh"].get<std::string>() << " | ";
  if (row.contains("failed"))
  {
    std::cout << "| " << row["solver"].get<std::string>()
              << " | failed: " << row["failed"].get<std::string>() << " | | | | | | | |\n";
    return;
  }
  std::cout << row["vertices"] << " / " << row["levels"] << " | "
            << row["solver"].get<std::string>();
  for (const char* key :
    { "io_seconds", "hierarchy_seconds", "multigrid_seconds", "total_seconds" })
  {
    std::cout << " | " << text("%.2f s", row[key]);
  }
  std::cout << " | " << row["cycles"] << " | " << row["peak_nodes"];
  for (const char* key : { "pool_bytes", "process_bytes" })
  {
    constexpr double Mebibyte = 1 << 20;
    std::cout << " | " << text("%.0f MiB", row[key].get<double>() / Mebibyte);
  }
  std::cout << " |\n";
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Time and memory of solves out of core and in core.");
  Task task;
  std::vector<std::string> meshes;
  std::string jsonFile;
  app.add_option("MESH", meshes, ".vsm files")->required()->check(CLI::ExistingFile);
  app.add_option("--tolerance", task.tolerance, "Of the relative residual")->capture_default_str();
  app.add_option("--threads", task.threads, "Of each solve")->capture_default_str();
  app.add_option("--json", jsonFile, "Where to write the numbers");
  CLI11_PARSE(app, argc, argv);

  const smg::testing::TemporaryFolder folder;
  task.solution = folder / "solution";
  json rows = json::array();
  for (const std::string& mesh : meshes)
  {
    task.mesh = mesh;
    for (const bool inCore : { false, true })
    {
      std::cerr << mesh << (inCore ? ", in core ...\n" : " ...\n");
      rows.push_back(measure(task, inCore));
    }
  }
  std::cout << "| mesh | vertices / levels | solver | I/O | H.C. | M.O. | total | V-cycles | "
               "peak nodes | accounted memory | process |\n"
            << "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const json& row : rows)
  {
    printRow(row);
  }
  smg::benchmark::writeNumbers(
    jsonFile, { { "tolerance", task.tolerance }, { "threads", task.threads }, { "rows", rows } });
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_table3: " << error.what() << '\n';
  return 1;
}
