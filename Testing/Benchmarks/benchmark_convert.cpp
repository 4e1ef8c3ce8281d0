// SPDX-License-Identifier: BSD-3-Clause
// benchmark_convert MESH : converts a mesh file to a stream with several orders and memory limits,
// each in a process of its own, and measures time, memory, the traffic and size of the scratch
// files, and how good the order is beside a breadth-first order made in core.
//
//   benchmark_convert dragon.ply --json dragon.json
//
// prints a Markdown table and writes the numbers. Scratch files and output go to the system's
// temporary folder (TMPDIR). With --address-space a conversion that takes more
// memory than that from the system fails, whatever the accounts say.

#include "Testing/Benchmarks/ChildProcess.h"
#include "Testing/Benchmarks/MeasuredConversion.h"
#include "Testing/Benchmarks/OrderQuality.h"
#include "Testing/Benchmarks/Output.h"
#include "Testing/Support/TemporaryFolder.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::ConversionTask;
using smg::benchmark::text;

constexpr std::int64_t Mebibyte = std::int64_t(1) << 20;
/** For more vertices the order in core may need more memory than the machine has. */
constexpr std::int64_t MaxVerticesInCore = 4'000'000;

struct Options
{
  std::string mesh, jsonFile;
  std::vector<std::int64_t> memory = { 64, 256 };
  std::vector<std::string> orders = { "bfs", "spectral", "axis", "keep" };
  std::int64_t addressSpace = 0;
};

/** Adds the quality of the order; `inCore` is filled at the first call. */
void judge(json& result, const std::filesystem::path& output, json& inCore)
{
  using namespace smg::benchmark;
  if (inCore.is_null())
  {
    inCore = runInChild([&] { return orderInCore(output); });
  }
  const json quality = runInChild([&] { return orderOfFile(output); });
  result["quality"] = quality;
  if (quality.contains("failed"))
  {
    result["failed"] = quality["failed"];
  }
  else if (quality["span"] != result["span"] || quality["width"] != result["width"])
  {
    result["failed"] = "the report has another span or width than the file";
  }
}

json measure(const ConversionTask& task, json& inCore)
{
  json result = smg::benchmark::measureConversion(task);
  if (!result.contains("failed") && result["vertices"] < MaxVerticesInCore)
  {
    judge(result, task.output, inCore);
  }
  std::filesystem::remove(task.output);
  return result;
}

/** The number of an order, and its ratio to that of the order in core. */
std::string quality(const json& result, const json& inCore, const char* key)
{
  if (!result.contains("quality") || !result["quality"].contains(key))
  {
    return "-";
  }
  const double value = result["quality"][key];
  const std::string number = text("%.0f", value);
  return inCore.contains(key) ? number + text(" (%.2f)", value / inCore[key].get<double>())
                              : number;
}

void printRow(const json& result, const json& inCore)
{
  std::cout << "| " << result["order"].get<std::string>() << " | " << result["memory_mib"];
  if (result.contains("failed"))
  {
    std::cout << " | failed: " << result["failed"].get<std::string>() << " | | | | | | | | | | |\n";
    return;
  }
  const double vertices = result["vertices"];
  const auto perVertex = [&](const char* format, const char* key, double unit = 1)
  { std::cout << " | " << text(format, unit * result[key].get<double>() / vertices); };
  const auto mebibytes = [&](const char* key)
  { std::cout << " | " << text("%.0f", result[key].get<double>() / Mebibyte); };
  perVertex("%.2f", "cpu_seconds", 1e6);
  std::cout << " | "
            << text("%.2f",
                 result["wall_seconds"].get<double>() / result["cpu_seconds"].get<double>());
  mebibytes("pool_bytes_peak");
  mebibytes("peak_bytes");
  perVertex("%.0f", "scratch_bytes_read");
  perVertex("%.0f", "scratch_bytes_written");
  perVertex("%.0f", "scratch_bytes_peak");
  perVertex("%.1f", "output_bytes");
  for (const char* key : { "span", "width", "mean_window" })
  {
    std::cout << " | " << quality(result, inCore, key);
  }
  std::cout << " |\n";
}

void printTable(const json& results, const json& inCore)
{
  std::cout << "| order | memory MiB | CPU us/vertex | wall/CPU | accounted MiB | resident MiB | "
               "scratch bytes/vertex: read | written | largest | output bytes/vertex | "
               "span (of in core) | width | mean window |\n"
            << "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const json& result : results)
  {
    printRow(result, inCore);
  }
  if (inCore.contains("span"))
  {
    std::cout << "| in core, bfs | | | | | | | | | | " << inCore["span"] << " | " << inCore["width"]
              << " | " << text("%.0f", inCore["mean_window"]) << " |\n";
  }
}

/** What all conversions of the mesh have in common. */
void printTitle(const Options& options, const json& results)
{
  std::cout << std::filesystem::path(options.mesh).filename().string();
  for (const json& result : results)
  {
    if (!result.contains("failed"))
    {
      std::cout << ": " << result["vertices"] << " vertices, " << result["cells"] << " cells, "
                << std::filesystem::file_size(options.mesh) / Mebibyte << " MiB";
      break;
    }
  }
  if (options.addressSpace > 0)
  {
    std::cout << ", address space " << options.addressSpace << " MiB";
  }
  std::cout << "\n\n";
}

void run(const Options& options)
{
  const smg::testing::TemporaryFolder folder;
  ConversionTask task;
  task.mesh = options.mesh;
  // The output is outside the folder whose size is measured.
  task.scratch = folder / "scratch";
  task.output = folder / "converted.vsm";
  std::filesystem::create_directory(task.scratch);
  task.addressSpace = options.addressSpace * Mebibyte;
  json results = json::array();
  json inCore;
  for (const std::string& order : options.orders)
  {
    for (const std::int64_t memory : options.memory)
    {
      std::cerr << order << ", " << memory << " MiB ...\n";
      task.order = order;
      task.memory = memory * Mebibyte;
      json result = measure(task, inCore);
      result["order"] = order;
      result["memory_mib"] = memory;
      results.push_back(result);
    }
  }
  printTitle(options, results);
  printTable(results, inCore);
  smg::benchmark::writeNumbers(
    options.jsonFile, { { "mesh", options.mesh }, { "address_space_mib", options.addressSpace },
                        { "in_core", inCore }, { "results", results } });
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("Measures the conversion of one mesh file.");
  Options options;
  app.add_option("MESH", options.mesh, "Of any format that smg convert reads")
    ->required()
    ->check(CLI::ExistingFile);
  app.add_option("--memory", options.memory, "Limits in MiB, separated by commas")
    ->delimiter(',')
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  app.add_option("--orders", options.orders, "Which ones, separated by commas")
    ->delimiter(',')
    ->check(CLI::IsMember({ "bfs", "spectral", "axis", "keep" }))
    ->capture_default_str();
  app
    .add_option("--address-space", options.addressSpace,
      "Most MiB of address space of a conversion, as ulimit -v; 0: no limit")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  app.add_option("--json", options.jsonFile, "Where to write the numbers");
  CLI11_PARSE(app, argc, argv);
  run(options);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_convert: " << error.what() << '\n';
  return 1;
}
