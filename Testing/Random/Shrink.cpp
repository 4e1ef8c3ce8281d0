// SPDX-License-Identifier: BSD-3-Clause
// Delta debugging (Zeller and Hildebrandt 2002): halves, quarters, ... of the cells are left out as
// long as the case still fails, and so are parts of the problem and of the run.
#include "Testing/Random/Check.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

using nlohmann::json;

/** The kind of a failure: its text without the numbers. */
std::string kindOf(const Case& given)
{
  std::string failure = check(given).failure;
  std::erase_if(failure, [](char c) { return std::string("0123456789.e+-").find(c) < 99; });
  return failure;
}

/** Replaces the case by `next` if that fails in the same way. */
bool take(Case& given, const Case& next)
{
  const std::string kind = kindOf(next);
  const bool isTaken = !kind.empty() && kind == kindOf(given);
  given = isTaken ? next : given;
  return isTaken;
}

bool leaveOutCells(Case& given)
{
  bool isAny = false;
  for (std::int64_t length = given.cells() / 2; length >= 1; length /= 2)
  {
    for (std::int64_t begin = 0; begin < given.cells() && given.cells() > 1;)
    {
      std::vector<std::uint8_t> kept(static_cast<std::size_t>(given.cells()), 1);
      const std::int64_t end = std::min(begin + length, given.cells());
      std::fill(kept.begin() + begin, kept.begin() + end, 0);
      const bool isTaken = end - begin < given.cells() && take(given, given.part(kept));
      isAny = isAny || isTaken;
      begin = isTaken ? begin : end;
    }
  }
  return isAny;
}

/** All problems with one part less, or a list replaced by one of its entries' values. */
void simpler(const json& from, const std::function<void(const json&)>& visit)
{
  if (from.is_object())
  {
    for (const auto& [key, value] : from.items())
    {
      json less = from;
      less.erase(key);
      visit(less);
      simpler(value,
        [&, key = key](const json& part)
        {
          json with = from;
          with[key] = part;
          visit(with);
        });
    }
  }
  else if (from.is_array() && !from.empty() && from[0].is_object())
  {
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      if (from.size() > 1)
      {
        json less = from;
        less.erase(k);
        visit(less);
      }
      simpler(from[k],
        [&](const json& part)
        {
          json with = from;
          with[k] = part;
          visit(with);
        });
    }
  }
  else if (from.is_string())
  {
    visit(1.0);
  }
}

bool leaveOutData(Case& given)
{
  bool isAny = false;
  for (bool isTaken = true; isTaken;)
  {
    isTaken = false;
    const json problem = given.problem;
    simpler(problem,
      [&](const json& less)
      {
        if (!isTaken)
        {
          Case next = given;
          next.problem = less;
          isTaken = take(given, next);
        }
      });
    isAny = isAny || isTaken;
  }
  return isAny;
}

void simplifyRun(Case& given)
{
  const std::vector<std::function<void(CaseRun&)>> changes{ [](CaseRun& run) { run.cancelAt = 0; },
    [](CaseRun& run) { run.isKilled = false; }, [](CaseRun& run) { run.memory = 0.0; },
    [](CaseRun& run) { run.relation.clear(); }, [](CaseRun& run) { run.unused = 0; },
    [](CaseRun& run) { run.pieces = 1; }, [](CaseRun& run) { run.door = "c++"; },
    [](CaseRun& run) { run.order = "keep"; }, [](CaseRun& run) { run.inCore = true; },
    [](CaseRun& run) { run.threads = 1; }, [](CaseRun& run) { run.coreNodes = 50000; },
    [](CaseRun& run) { run.blockNodes = 4096; }, [](CaseRun& run) { run.blockCells = 1000000; },
    [](CaseRun& run) { run.sweeps = 2; }, [](CaseRun& run) { run.acceleration = 0; } };
  for (const auto& change : changes)
  {
    Case next = given;
    change(next.run);
    take(given, next);
  }
}

/** Leaves out the columns that the problem does not name. */
void leaveOutColumns(Case& given)
{
  Case next = given;
  const std::string text = given.problem.dump();
  for (std::vector<CaseColumn>* columns : { &next.vertexColumns, &next.cellColumns })
  {
    std::erase_if(*columns,
      [&](const CaseColumn& column) {
        return !isGroupColumn(column.name) &&
               text.find('"' + column.name + '"') == std::string::npos;
      });
  }
  take(given, next);
}

} // namespace

Case shrink(const Case& failing)
{
  Case small = failing;
  simplifyRun(small);
  for (bool isSmaller = true; isSmaller;)
  {
    isSmaller = leaveOutData(small);
    isSmaller = leaveOutCells(small) || isSmaller;
  }
  leaveOutColumns(small);
  return small;
}

} // namespace smg::testing
