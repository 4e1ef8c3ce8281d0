// SPDX-License-Identifier: BSD-3-Clause
// benchmark_schedule MESH.vsm : how much faster a solve becomes with more threads, from the times
// of its stages.
//
//   benchmark_schedule arm.vsm --json arm-schedule.json
//
// solves (FixedEndsProblem.h) on one thread and measures the processor time of each stage in each
// step of each pass. A model then gives every stage to the thread that is free first, as the solve
// does, for 1 to 64 threads; it knows neither the speed of memory nor the cost of waking threads.
// The longest stage is the limit for any number of threads. Two Markdown tables: the stages, and
// the model. --measure adds the wall times of solves with as many threads as the machine has cores.

#include "Solver/Core/Timer.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Engine/PoissonSolver.h"
#include "Solver/Multigrid/Extended.h"
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Benchmarks/Output.h"
#include "Testing/Benchmarks/ScheduleModel.h"
#include "smg/VsmReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace
{

using nlohmann::json;
using smg::benchmark::text;

constexpr int Models[] = { 1, 2, 4, 8, 16, 32, 64 };

struct Options
{
  std::string mesh, jsonFile;
  bool measures = false, inCore = false;
  int repetitions = 3;
};

smg::SolveOptions solveOptions(const Options& options, int threads)
{
  smg::SolveOptions solve;
  solve.threads = threads;
  solve.inCore = options.inCore;
  solve.memoryLimit = std::int64_t(1) << 40;
  return solve;
}

/** The recorded passes of a solve on one thread. */
std::vector<smg::StepRecorder::Pass> record(const Options& options)
{
  const smg::VsmReader reader(options.mesh);
  const auto source = reader.source();
  smg::benchmark::FixedEndsProblem problem(reader.info());
  smg::SolveOptions solve = solveOptions(options, 1);
  solve.blockNodes = smg::RowBlock::Nodes;
  smg::PoissonSolver solver(
    compiled(smg::Extended::forCells(reader.info().cellType)), problem.columns(), solve);
  smg::StepRecorder recorder;
  solver.context().threads.recorder = &recorder;
  // The recorder lives longer than the solution.
  const auto solution = solver.solve(*source, problem);
  return recorder.passes();
}

/** The wall time of a solve: the least of some. */
double measure(const Options& options, int threads)
{
  double least = 0.0;
  for (int n = 0; n < options.repetitions; ++n)
  {
    const smg::VsmReader reader(options.mesh);
    const auto source = reader.source();
    smg::benchmark::FixedEndsProblem problem(reader.info());
    const smg::Timer timer;
    const auto solution = smg::solve(*source, problem, solveOptions(options, threads));
    least = n == 0 ? timer.seconds() : std::min(least, timer.seconds());
  }
  return least;
}

/** The seconds of each task of some passes, and of what runs between the steps. */
json stagesOf(
  const std::vector<smg::StepRecorder::Pass>& passes, std::size_t begin, std::size_t end)
{
  double serial = 0.0;
  std::vector<double> tasks;
  for (std::size_t pass = begin; pass < end; ++pass)
  {
    for (const smg::StepRecorder::Step& step : passes[pass].steps)
    {
      serial += step.before;
      tasks.resize(std::max(tasks.size(), step.tasks.size()));
      std::ranges::transform(step.tasks, tasks, tasks.begin(), std::plus());
    }
  }
  return { { "between", serial }, { "tasks", tasks } };
}

json modelOf(const std::vector<smg::StepRecorder::Pass>& passes, const Options& options)
{
  const smg::benchmark::ScheduleModel model(passes, smg::SolveOptions().blockNodes);
  const double alone = model.seconds(1), first = model.seconds(0, 1);
  json rows = json::array();
  for (const int threads : Models)
  {
    json row = { { "threads", threads }, { "speed_up", alone / model.seconds(threads) },
      { "first_pass", first / model.seconds(0, threads) },
      { "later_passes", (alone - first) / (model.seconds(threads) - model.seconds(0, threads)) } };
    if (options.measures && threads <= static_cast<int>(std::thread::hardware_concurrency()))
    {
      row["wall"] = measure(options, threads);
    }
    rows.push_back(std::move(row));
  }
  double critical = model.critical(0);
  for (std::size_t pass = 1; pass < passes.size(); ++pass)
  {
    critical += model.critical(pass);
  }
  return { { "seconds", alone }, { "limit", alone / critical }, { "rows", std::move(rows) } };
}

void printStages(const char* name, const json& stages, double whole)
{
  std::cout << "| " << name << " | between steps | "
            << text("%.1f", 100.0 * stages["between"].get<double>() / whole) << " |\n";
  int number = 0;
  for (const double seconds : stages["tasks"])
  {
    std::cout << "| | task " << number++ << " | " << text("%.1f", 100.0 * seconds / whole)
              << " |\n";
  }
}

void print(const json& result)
{
  const json& model = result["model"];
  const double whole = model["seconds"];
  std::cout << "| | | % of the CPU time |\n| --- | --- | --- |\n";
  printStages("first pass", result["first_pass"], whole);
  printStages("later passes", result["later_passes"], whole);
  std::cout << "\n| threads | speed-up | first pass | later passes | measured |\n"
               "| --- | --- | --- | --- | --- |\n";
  for (const json& row : model["rows"])
  {
    const double alone = model["rows"][0].value("wall", 0.0);
    std::cout << "| " << row["threads"] << " | " << text("%.2f", row["speed_up"]) << " | "
              << text("%.2f", row["first_pass"]) << " | " << text("%.2f", row["later_passes"])
              << " | "
              << (row.contains("wall") ? text("%.2f", alone / row["wall"].get<double>()) : "")
              << " |\n";
  }
  std::cout << "| any | " << text("%.2f", model["limit"]) << " | | | |\n";
}

} // namespace

int main(int argc, char** argv)
try
{
  Options options;
  CLI::App app{ "The speed-up of a solve with the number of threads" };
  app.add_option("mesh", options.mesh, "a .vsm file")->required()->check(CLI::ExistingFile);
  app.add_flag("--in-core", options.inCore, "solve in core");
  app.add_flag("--measure", options.measures, "measure wall times, too");
  app.add_option(
    "--repetitions", options.repetitions, "solves of each, of which the fastest counts");
  app.add_option("--json", options.jsonFile, "where to write the numbers");
  CLI11_PARSE(app, argc, argv);
  const auto passes = record(options);
  const json result = { { "mesh", options.mesh }, { "first_pass", stagesOf(passes, 0, 1) },
    { "later_passes", stagesOf(passes, 1, passes.size()) }, { "model", modelOf(passes, options) } };
  print(result);
  smg::benchmark::writeNumbers(options.jsonFile, result);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "benchmark_schedule failed: " << error.what() << '\n';
  return 1;
}
