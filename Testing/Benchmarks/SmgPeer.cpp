// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Timer.h"
#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "Testing/Benchmarks/Peers.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Error.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

namespace smg::benchmark
{
namespace
{

/** A mesh stream that measures the time of its reading and decoding. */
class TimedSource : public MeshSource
{
public:
  explicit TimedSource(std::unique_ptr<MeshSource> source)
    : Source(std::move(source))
  {
  }
  const StreamInfo& info() const override { return this->Source->info(); }
  bool next(MeshBlock& block) override
  {
    const Timer timer;
    const bool isThere = this->Source->next(block);
    this->Seconds += timer.seconds();
    return isThere;
  }
  double seconds() const { return this->Seconds; }

private:
  std::unique_ptr<MeshSource> Source;
  double Seconds = 0.0;
};

/** Copies the solution to the task's file, one range at a time. */
void save(const Task& task, Solution& solution)
{
  constexpr std::int64_t Stretch = 16384;
  std::vector<double> values;
  std::ofstream file(task.solution, std::ios::binary);
  for (std::int64_t first = 0; first < solution.vertices(); first += Stretch)
  {
    const std::int64_t count = std::min(Stretch, solution.vertices() - first);
    values.resize(count * solution.columns());
    solution.read(first, count, values);
    file.write(reinterpret_cast<const char*>(values.data()),
      static_cast<std::streamsize>(values.size() * sizeof(double)));
  }
  if (!file.flush())
  {
    throw Error(task.solution.string() + ": cannot be written.");
  }
}

nlohmann::json run(const Task& task, bool inCore)
{
  CpuClock clock;
  const VsmReader reader(task.mesh);
  TimedSource source(reader.source());
  FixedEndsProblem problem(reader.info());
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
  save(task, *solution);

  const Report& report = solution->report();
  nlohmann::json answer = { { "cpu_total", cpu }, { "peak_bytes", peak },
    { "iterations", report.cycles }, { "converged", report.converged } };
  answer["mesh_seconds"] = source.seconds();
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
