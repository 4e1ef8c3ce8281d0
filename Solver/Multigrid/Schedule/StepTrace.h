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

/** Calls a TraceFunction after each step of a pass with the nodes that each stage has passed and
 * those that each level has in memory, where these are not as after the step before. */
class StepTrace
{
public:
  using Node = std::function<std::int64_t()>;

  /** Disabled, at no cost. */
  StepTrace() = default;
  /** Of a pass, the first being 1. Disabled if the function is empty; it must outlive this. */
  StepTrace(const TraceFunction& function, int pass)
    : Function(function ? &function : nullptr)
    , Pass(pass)
  {
  }

  bool isEnabled() const { return this->Function != nullptr; }

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

  /** Reports a step. To be called when no task runs. */
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
        (*this->Function)({ this->Pass, this->Step, traced.level, traced.name, first, end });
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
    if (this->isEnabled())
    {
      this->All.push_back(std::move(traced));
    }
  }

  const TraceFunction* Function = nullptr;
  int Pass = 0;
  std::int64_t Step = 0;
  std::vector<Traced> All;
};

} // namespace smg
