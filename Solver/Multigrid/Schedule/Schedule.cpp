// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <algorithm>
#include <numeric>
#include <utility>

// Cuts a sequence of stages into chains of similar cost. Stages cannot be reordered, so a chain is
// an interval; each stage goes to the chain in whose share of the total cost its middle lies. The
// cut only decides which stages may run at the same time: it changes the memory of a pass, but not
// a bit of its result.

namespace smg
{
namespace
{

int scheduledThreads(int wanted)
{
  // A pass has about this number of stages of similar length: more threads would find nothing to
  // do.
  constexpr int Most = 16;
  return std::min(Most, wanted > 0 ? wanted : Workers::cores());
}

} // namespace

StepThreads::StepThreads(int wanted)
  : scheduled(scheduledThreads(wanted))
  , workers(std::min(this->scheduled, Workers::cores()))
{
}

void Schedule::add(Stage stage)
{
  this->Stages.push_back(std::move(stage));
  this->Seconds.push_back(0.0);
  if (this->Ends.empty())
  {
    this->Ends.emplace_back();
  }
  this->Ends.back() = this->Stages.size();
}

void Schedule::add(Stage stage, StepTrace::Node cursor, std::size_t sweep)
{
  if (this->Trace.isEnabled())
  {
    const std::string name = stage.name;
    this->Trace.addStage(
      sweep > 0 ? name + ", " + std::to_string(sweep) : name, stage.level, std::move(cursor));
  }
  this->add(std::move(stage));
}

void Schedule::startChain()
{
  // The last chain has no stages if it was started before.
  if (!this->Ends.empty() && this->begin(this->chains() - 1) < this->Ends.back())
  {
    this->Ends.push_back(this->Ends.back());
  }
}

std::vector<double> Schedule::costs() const
{
  std::vector<double> costs;
  for (const Stage& stage : this->Stages)
  {
    costs.push_back(stage.cost);
  }
  return costs;
}

void Schedule::cut(int chains)
{
  double total = 0.0;
  for (const Stage& stage : this->Stages)
  {
    total += stage.cost;
  }
  // A chain has the stages whose middles lie in its share of the whole. A stage longer than a share
  // leaves the next chain empty, which is then left out: there may be fewer chains.
  this->Ends.clear();
  double before = 0.0;
  int chain = 0;
  for (std::size_t s = 0; s < this->Stages.size(); ++s)
  {
    const double middle = before + this->Stages[s].cost / 2;
    const auto of = total > 0.0 ? static_cast<int>(chains * middle / total) : 0;
    if (s > 0 && of != chain)
    {
      this->Ends.push_back(s);
    }
    chain = of;
    before += this->Stages[s].cost;
  }
  this->Ends.push_back(this->Stages.size());
}

void Schedule::cutAll()
{
  this->Ends.resize(this->Stages.size());
  std::iota(this->Ends.begin(), this->Ends.end(), std::size_t(1));
}

void Schedule::run(int task)
{
  if (task >= this->chains())
  {
    this->Beside[static_cast<std::size_t>(task - this->chains())]();
    return;
  }
  const std::size_t first = this->begin(task);
  for (std::size_t s = first; s < this->begin(task + 1); ++s)
  {
    const Timer timer;
    // The first stage of a chain sees published cursors only.
    this->Stages[s].advance(s > first);
    this->Seconds[s] += timer.seconds();
  }
}

void Schedule::advance(std::size_t first)
{
  for (std::size_t s = first; s < this->Stages.size(); ++s)
  {
    const Timer timer;
    this->Stages[s].advance(true);
    this->Seconds[s] += timer.seconds();
  }
}

void Schedule::perform(
  StepThreads& threads, const std::function<bool()>& prepare, const std::function<void()>& settle)
{
  LongestTaskFirst order(this->tasks());
  const auto runAt = [&](int place)
  {
    const int task = order[place];
    const Timer timer;
    this->run(task);
    order.add(task, timer.seconds());
  };
  while (prepare())
  {
    if (threads.recorder)
    {
      threads.recorder->startStep();
    }
    if (threads.recorder || threads.scheduled == 1)
    {
      // One after the other: the order does not matter.
      for (int task = 0; task < this->tasks(); ++task)
      {
        this->run(task);
        if (threads.recorder)
        {
          threads.recorder->endTask();
        }
      }
    }
    else
    {
      runAll(threads.workers, this->tasks(), runAt);
      order.sort();
    }
    settle();
    this->Trace.endStep();
  }
}

} // namespace smg
