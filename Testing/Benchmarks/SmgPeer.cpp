// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Benchmarks/Peers.h"
#include "Testing/Benchmarks/SavedSolution.h"
#include "Testing/Benchmarks/TimedMesh.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

namespace smg::benchmark
{
namespace
{

nlohmann::json run(const Task& task, bool inCore)
{
  CpuClock clock;
  const VsmReader reader(task.mesh);
  double reading = 0.0;
  TimedSource source(reader.source(), reading);
  FixedEndsProblem problem(reader.info(), task.start);
  SolveOptions options;
  options.tolerance = task.tolerance;
  options.threads = task.threads;
  options.scratch = task.solution.parent_path();
  options.inCore = inCore;
  if (inCore)
  {
    options.memoryLimit = std::int64_t(1) << 40;
  }
  const auto solution = solve(source, problem, options);
  const double cpu = clock.lap();
  const std::int64_t peak = peakBytes();
  saveSolution(*solution, task.solution);

  const Report& report = solution->report();
  nlohmann::json answer = { { "cpu_total", cpu }, { "peak_bytes", peak },
    { "iterations", report.cycles }, { "converged", report.converged } };
  answer["mesh_seconds"] = reading;
  answer["report"] = nlohmann::json::parse(report.json());
  return answer;
}

} // namespace

nlohmann::json runStreaming(const Task& task)
{
  return run(task, false);
}

nlohmann::json runInCore(const Task& task)
{
  return run(task, true);
}

} // namespace smg::benchmark
