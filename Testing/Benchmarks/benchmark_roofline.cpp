// SPDX-License-Identifier: BSD-3-Clause
// benchmark_roofline MESH.vsm : how near a pass of the streaming solve comes to what the machine's
// memory, page cache and disk allow.
//
//   benchmark_roofline arm.vsm --scratch /mnt/disk --json arm-roofline.json
//
// measures these bandwidths, solves (FixedEndsProblem.h), and prints two Markdown tables: the bytes
// a vertex that a pass after the first one reads and writes, by kind and level; and for each bound
// the time that these bytes take at its bandwidth over the time that the pass took. The bound of
// the memory counts every byte once; the system copies it, so that a share of one half is the most.

#include "Testing/Benchmarks/Bandwidth.h"
#include "Testing/Benchmarks/ChildProcess.h"
#include "Testing/Benchmarks/Output.h"
#include "Testing/Benchmarks/Peers.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::Task;
using smg::benchmark::text;

constexpr std::int64_t Mebibyte = std::int64_t(1) << 20;
constexpr double Gigabyte = 1e9;

struct Options
{
  std::string mesh, jsonFile;
  std::filesystem::path scratch = std::filesystem::temp_directory_path();
  std::vector<int> threads = { 1, 2 };
  std::int64_t fileMebibytes = 1024, memoryMebibytes = 256;
};

/**
 * What a pass after the first one reads and writes. Of p passes, the last p - 1 read every file
 * except the history of the acceleration, which they write, and which is read from the third pass
 * on. The state is written in all passes, the rest in the first one only. The traffic of components
 * without prescribed value outside the passes is spread over them.
 */
json bytesOfPass(const json& report)
{
  const double passes = report["passes"];
  const double later = std::max(1.0, passes - 1.0);
  json kinds = json::array();
  for (const json& traffic : report["bytes_by_kind"])
  {
    const bool inFirst = traffic["kind"] != "history";
    const bool inLater = traffic["kind"] == "state" || !inFirst;
    const double written =
      traffic["written"].get<double>() / ((inFirst ? 1.0 : 0.0) + (inLater ? later : 0.0));
    kinds.push_back({ { "kind", traffic["kind"] }, { "level", traffic.value("level", -1) },
      { "first_pass_written", inFirst ? written : 0.0 },
      { "read", traffic["read"].get<double>() / (inFirst ? later : std::max(1.0, later - 1.0)) },
      { "written", inLater ? written : 0.0 } });
  }
  return kinds;
}

json solve(const Options& options, int threads)
{
  Task task;
  task.mesh = options.mesh;
  task.solution = options.scratch / "benchmark_roofline.solution";
  task.threads = threads;
  json result = smg::benchmark::runInChild([&] { return smg::benchmark::runStreaming(task); });
  std::filesystem::remove(task.solution);
  if (result.contains("failed"))
  {
    throw smg::Error(result["failed"].get<std::string>());
  }
  return std::move(result["report"]);
}

double sum(const json& kinds, const char* key)
{
  double total = 0.0;
  for (const json& kind : kinds)
  {
    total += kind[key].get<double>();
  }
  return total;
}

void printBytes(const json& kinds, double vertices)
{
  std::cout << "| bytes a vertex | level | first pass written | later pass read | written |\n"
            << "|---|---|---|---|---|\n";
  const auto print = [&](const std::string& name, const std::string& level, auto&& bytes)
  {
    std::cout << "| " << name << " | " << level;
    for (const char* key : { "first_pass_written", "read", "written" })
    {
      std::cout << " | " << text("%.1f", bytes(key) / vertices);
    }
    std::cout << " |\n";
  };
  for (const json& kind : kinds)
  {
    const int level = kind["level"];
    print(kind["kind"], level < 0 ? "" : std::to_string(level),
      [&](const char* key) { return kind[key].get<double>(); });
  }
  print("all", "", [&](const char* key) { return sum(kinds, key); });
}

/** A bound on what a pass reads and writes per second. */
json boundOf(const char* name, double readBandwidth, double writeBandwidth, const json& kinds,
  double measuredSeconds)
{
  const double seconds =
    sum(kinds, "read") / readBandwidth + sum(kinds, "written") / writeBandwidth;
  return { { "bound", name }, { "read_bandwidth", readBandwidth },
    { "write_bandwidth", writeBandwidth }, { "bound_seconds", seconds },
    { "pass_seconds", measuredSeconds }, { "share", seconds / measuredSeconds } };
}

void printBounds(const json& runs)
{
  std::cout << "| threads | bound | GB/s read | GB/s written | pass at the bound | pass measured | "
               "share of the bound |\n"
            << "|---|---|---|---|---|---|---|\n";
  for (const json& run : runs)
  {
    for (const json& bound : run["bounds"])
    {
      std::cout << "| " << run["threads"] << " | " << bound["bound"].get<std::string>();
      for (const char* key : { "read_bandwidth", "write_bandwidth" })
      {
        std::cout << " | " << text("%.2f", bound[key].get<double>() / Gigabyte);
      }
      std::cout << " | " << text("%.3f s", bound["bound_seconds"]) << " | "
                << text("%.3f s", bound["pass_seconds"]) << " | "
                << text("%.0f %%", 100.0 * bound["share"].get<double>()) << " |\n";
    }
  }
}

void run(const Options& options)
{
  const auto file =
    smg::benchmark::fileBandwidth(options.scratch, options.fileMebibytes * Mebibyte);
  json runs = json::array();
  json kinds;
  double vertices = 0;
  for (const int threads : options.threads)
  {
    std::cerr << threads << " threads ...\n";
    const double memory =
      smg::benchmark::memoryBandwidth(threads, options.memoryMebibytes * Mebibyte);
    const json report = solve(options, threads);
    const int later = report["passes"].get<int>() - 1;
    if (later < 1)
    {
      throw smg::Error(
        options.mesh + ": solved in the first pass; there is no later pass to measure.");
    }
    kinds = bytesOfPass(report);
    vertices = report["vertices"];
    const double seconds = report["seconds"]["solve"].get<double>() / later;
    runs.push_back({ { "threads", threads }, { "passes", report["passes"] },
      { "bounds", { boundOf("memory, triad", memory, memory, kinds, seconds),
                    boundOf("page cache", file.cachedRead, file.cachedWrite, kinds, seconds),
                    boundOf("disk", file.diskRead, file.diskWrite, kinds, seconds) } } });
  }
  std::cout << std::filesystem::path(options.mesh).filename().string() << ": "
            << text("%.0f", vertices) << " vertices, 3 columns\n\n";
  printBytes(kinds, vertices);
  std::cout << '\n';
  printBounds(runs);
  smg::benchmark::writeNumbers(
    options.jsonFile, { { "mesh", options.mesh }, { "vertices", vertices },
                        { "bytes_of_pass", kinds }, { "runs", runs } });
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Compares a pass of the solver with the bandwidths of the machine.");
  Options options;
  app.add_option("MESH", options.mesh, "A .vsm file")->required()->check(CLI::ExistingFile);
  app.add_option("--scratch", options.scratch, "Folder of the solver's and the measured file")
    ->check(CLI::ExistingDirectory)
    ->capture_default_str();
  app.add_option("--threads", options.threads, "Of each solve, separated by commas")
    ->delimiter(',')
    ->check(CLI::Range(1, 64))
    ->capture_default_str();
  app.add_option("--file", options.fileMebibytes, "MiB of the file that is written and read")
    ->check(CLI::Range(1, 1 << 20))
    ->capture_default_str();
  app.add_option("--arrays", options.memoryMebibytes, "MiB of each array of the triad")
    ->check(CLI::Range(1, 1 << 14))
    ->capture_default_str();
  app.add_option("--json", options.jsonFile, "Where to write the numbers");
  CLI11_PARSE(app, argc, argv);
  run(options);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_roofline: " << error.what() << '\n';
  return 1;
}
