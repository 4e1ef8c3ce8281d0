// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/Pipeline.h"

#include <utility>

namespace smg
{

void Pipeline::add(double cost, Advance advance)
{
  this->Stages.push_back({ cost, std::move(advance) });
  this->Ends.assign(1, this->Stages.size());
}

void Pipeline::cut(int chains)
{
  double total = 0.0;
  for (const Stage& stage : this->Stages)
  {
    total += stage.cost;
  }
  // A chain has the stages whose middles lie in its share of the whole.
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

void Pipeline::advance(int chain) const
{
  const auto c = static_cast<std::size_t>(chain);
  const std::size_t first = c == 0 ? 0 : this->Ends[c - 1];
  for (std::size_t s = first; s < this->Ends[c]; ++s)
  {
    this->Stages[s].advance(s > first);
  }
}

void Pipeline::advance() const
{
  for (const Stage& stage : this->Stages)
  {
    stage.advance(true);
  }
}

} // namespace smg
