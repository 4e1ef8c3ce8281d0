// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Solve.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** Tells a TraceFunction, after each step of a pass, which nodes each stage has passed and which
 * ones each level has in memory, where that is not as after the step before. */
class StepTrace
{
public:
  using Node = std::function<std::int64_t()>;

  /** Tells nothing, at no cost. */
  StepTrace() = default;
  /** Of a pass, the first being 1. An empty function is told nothing. */
  StepTrace(const TraceFunction& tell, int pass)
    : Tell(tell ? &tell : nullptr)
    , Pass(pass)
  {
  }

  /** Whether anybody is told. */
  bool isTold() const { return this->Tell != nullptr; }

  /** Adds a stage: `cursor` is the next node that it will process. */
  void addStage(std::string name, int level, Node cursor)
  {
    this->add({ std::move(name), level, nullptr, std::move(cursor) });
  }
  /** Adds the nodes of a level that are in memory: from `first` to before `end`. */
  void addWindow(int level, Node first, Node end)
  {
    this->add({ "in memory", level, std::move(first), std::move(end) });
  }

  /** Tells of a step. To be called when no task runs. */
  void endStep()
  {
    ++this->Step;
    for (Traced& traced : this->All)
    {
      const std::int64_t end = traced.end();
      // What is released as a whole block may end behind the last node.
      const std::int64_t first = traced.first ? std::min(traced.first(), end) : traced.lastEnd;
      if (end != traced.lastEnd || (traced.first && first != traced.lastFirst))
      {
        (*this->Tell)({ this->Pass, this->Step, traced.level, traced.name, first, end });
      }
      traced.lastFirst = first;
      traced.lastEnd = end;
    }
  }

private:
  struct Traced
  {
    std::string name;
    int level;
    Node first, end;
    std::int64_t lastFirst = 0, lastEnd = 0;
  };

  void add(Traced traced)
  {
    if (this->isTold())
    {
      this->All.push_back(std::move(traced));
    }
  }

  const TraceFunction* Tell = nullptr;
  int Pass = 0;
  std::int64_t Step = 0;
  std::vector<Traced> All;
};

} // namespace smg
