// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/ScheduleModel.h"

#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace smg::benchmark
{

double ScheduleModel::seconds(std::size_t pass, int threads) const
{
  const std::vector<StepRecorder::Step> steps = this->scheduled(this->Passes[pass], threads);
  LongestTaskFirst order(steps.empty() ? 1 : static_cast<int>(steps.front().tasks.size()));
  double seconds = 0.0;
  for (const StepRecorder::Step& step : steps)
  {
    seconds += step.before + concurrent(step.tasks, order, threads);
    for (int task = 0; task < order.tasks(); ++task)
    {
      order.add(task, step.tasks[static_cast<std::size_t>(task)]);
    }
    order.sort();
  }
  return seconds;
}

double ScheduleModel::critical(std::size_t pass) const
{
  std::vector<double> ofTasks;
  double serial = 0.0;
  for (const StepRecorder::Step& step : this->Passes[pass].steps)
  {
    ofTasks.resize(std::max(ofTasks.size(), step.tasks.size()));
    std::ranges::transform(step.tasks, ofTasks, ofTasks.begin(), std::plus());
    serial += step.before;
  }
  return serial + *std::ranges::max_element(ofTasks);
}

double ScheduleModel::seconds(int threads) const
{
  double seconds = 0.0;
  for (std::size_t pass = 0; pass < this->Passes.size(); ++pass)
  {
    seconds += this->seconds(pass, threads);
  }
  return seconds;
}

/** The time of tasks of which every thread takes the next one; the first thread takes the first
 * one (see runAll()). */
double ScheduleModel::concurrent(
  const std::vector<double>& tasks, const LongestTaskFirst& order, int threads)
{
  std::vector<double> busy(static_cast<std::size_t>(threads));
  for (int place = 0; place < order.tasks(); ++place)
  {
    *std::ranges::min_element(busy) += tasks[static_cast<std::size_t>(order[place])];
  }
  return *std::ranges::max_element(busy);
}

/** The steps of a pass with as many chains as the pass has for these threads, and steps of as many
 * nodes. */
std::vector<StepRecorder::Step> ScheduleModel::scheduled(
  const StepRecorder::Pass& pass, int threads) const
{
  if (pass.costs.empty())
  {
    return pass.steps;
  }
  Schedule stages;
  for (const double cost : pass.costs)
  {
    stages.add({ "", 0, cost, {} });
  }
  stages.cut(Schedule::chainsFor(threads));
  const int chains = stages.chains();
  const auto together =
    static_cast<std::size_t>(Schedule::stepFor(threads, this->BlockNodes) / RowBlock::Nodes);
  std::vector<StepRecorder::Step> steps;
  for (std::size_t s = 0; s < pass.steps.size(); ++s)
  {
    const StepRecorder::Step& recorded = pass.steps[s];
    if (s % together == 0)
    {
      const std::size_t others = recorded.tasks.size() - pass.costs.size();
      steps.push_back({ 0.0, std::vector<double>(static_cast<std::size_t>(chains) + others) });
    }
    StepRecorder::Step& step = steps.back();
    step.before += recorded.before;
    auto task = recorded.tasks.begin();
    for (int chain = 0; chain < chains; ++chain)
    {
      const auto end =
        recorded.tasks.begin() + static_cast<std::ptrdiff_t>(stages.begin(chain + 1));
      step.tasks[static_cast<std::size_t>(chain)] += std::accumulate(task, end, 0.0);
      task = end;
    }
    std::transform(task, recorded.tasks.end(), step.tasks.begin() + chains,
      step.tasks.begin() + chains, std::plus());
  }
  return steps;
}

} // namespace smg::benchmark
