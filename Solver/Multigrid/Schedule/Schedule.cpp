// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Schedule/Schedule.h"

#include "Solver/Core/Timer.h"

#include <algorithm>
#include <numeric>
#include <utility>

// Cuts a sequence of stages into chains of similar cost. Stages cannot be reordered, so a chain is
// an interval; each stage goes to the chain in whose share of the total cost its middle lies. The
// cut only decides which stages may run at the same time: it changes the memory of a pass, but not
// a bit of its result.

namespace smg
{

void Schedule::add(Stage stage)
{
  this->Stages.push_back(std::move(stage));
  this->Seconds.push_back(0.0);
  // Until cut() is called all stages are one chain.
  this->Ends.assign(1, this->Stages.size());
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
    // The first stage of a chain sees published cursors only.
    this->advance(s, s > first);
  }
}

void Schedule::advance()
{
  for (std::size_t s = 0; s < this->Stages.size(); ++s)
  {
    this->advance(s, true);
  }
}

void Schedule::advance(std::size_t stage, bool follows)
{
  const Timer timer;
  this->Stages[stage].advance(follows);
  this->Seconds[stage] += timer.seconds();
}

} // namespace smg
