// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// How the passes of a solve move over the levels, as SolveOptions::trace reports it.

namespace smg::testing
{
namespace
{

struct Entry
{
  int pass;
  std::int64_t step;
  int level;
  std::string stage;
  std::int64_t first, end;
};

struct TracedSolve
{
  Solved solved;
  std::vector<Entry> entries;
  std::int64_t vertices;
};

SolveOptions manner(int threads, std::int64_t blockNodes, bool inCore)
{
  SolveOptions options = accurate();
  options.threads = threads;
  options.blockNodes = blockNodes;
  options.inCore = inCore;
  options.coreNodes = 300; // several streamed levels
  return options;
}

TracedSolve solveTraced(const StreamMesh& mesh, ArrayProblem problem, SolveOptions options)
{
  std::vector<Entry> entries;
  options.trace = [&entries](const TraceEntry& e) {
    entries.push_back({ e.pass, e.step, e.level, std::string(e.stage), e.first, e.end });
  };
  Solved solved = solveMesh(mesh, problem, options, 500);
  return { std::move(solved), std::move(entries), mesh.vertices() };
}

/** Calls check(traced, where) for a surface and a solid, out of core and in core, on one thread and
 * several, and in steps of different lengths. */
template <class Check>
void forTracedSolves(Check&& check)
{
  for (const bool isSolid : { false, true })
  {
    const StreamMesh mesh =
      toStream(shuffled(isSolid ? tetBox(20, 20, 20, 0.3) : torus(110, 60, 0.4)));
    const ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
    for (const auto& [threads, blockNodes, inCore] : { std::tuple(1, std::int64_t(300), false),
           std::tuple(4, std::int64_t(1000), false), std::tuple(1, std::int64_t(4096), true) })
    {
      SCOPED_TRACE(std::string(isSolid ? "solid" : "surface") + ", threads " +
                   std::to_string(threads) + (inCore ? ", in core" : ""));
      check(solveTraced(mesh, problem, manner(threads, blockNodes, inCore)));
    }
  }
}

/** The level whose nodes a stage on this level counts. */
int countedLevel(int level, const std::string& stage)
{
  return level + (stage == "P^T A P" || stage == "sparsify, finish rows" ? 1 : 0);
}

std::int64_t nodesOf(const TracedSolve& traced, int level)
{
  return level == 0 ? traced.vertices
                    : traced.solved.report.levels[static_cast<std::size_t>(level)].nodes;
}

} // namespace

TEST(Trace, EachStagePassesEachNode)
{
  forTracedSolves(
    [](const TracedSolve& traced)
    {
      std::map<std::tuple<int, int, std::string>, std::int64_t> ends;
      int passes = 0;
      for (const Entry& e : traced.entries)
      {
        passes = std::max(passes, e.pass);
        if (e.stage != "in memory")
        {
          EXPECT_LT(e.first, e.end);
          ends[{ e.pass, e.level, e.stage }] = e.end;
        }
      }
      EXPECT_EQ(passes, traced.solved.report.passes);
      // The first pass coarsens once more where the coarsest level turns out to be a streamed one.
      const int coarsest = static_cast<int>(traced.solved.report.levels.size()) - 1;
      int streamed = 0;
      for (const auto& [key, end] : ends)
      {
        const auto& [pass, level, stage] = key;
        if (level < coarsest)
        {
          EXPECT_EQ(end, nodesOf(traced, countedLevel(level, stage)))
            << pass << ' ' << level << ' ' << stage;
          streamed = std::max(streamed, level + 1);
        }
      }
      EXPECT_GE(streamed, 2);
      // Of each streamed level: six stages that coarsen it and four that begin a V-cycle; in later
      // passes three that finish one and these four.
      for (int level = 0; level < streamed; ++level)
      {
        for (const int pass : { 1, 2 })
        {
          const auto stages = std::ranges::count_if(ends,
            [&](const auto& item)
            {
              const std::string& stage = std::get<2>(item.first);
              return std::get<0>(item.first) == pass && std::get<1>(item.first) == level &&
                     stage != "assemble rows" && stage != "weigh cells" && stage != "close rows";
            });
          EXPECT_EQ(stages, pass == 1 ? 10 : 7) << level;
        }
      }
    });
}

TEST(Trace, StagesFollowEachOther)
{
  // On a level; the assembly on the finest one alone.
  const std::vector<std::string> first{ "assemble rows", "choose C-points, P0", "relax P", "A P",
    "pack rows", "relax before restriction, 1", "relax before restriction, 2", "combine iterates",
    "restrict the residual" };
  const std::vector<std::string> later{ "prolong the correction", "relax after prolongation, 1",
    "relax after prolongation, 2", "relax before restriction, 1", "relax before restriction, 2",
    "combine iterates", "restrict the residual" };
  forTracedSolves(
    [&](const TracedSolve& traced)
    {
      std::map<std::pair<int, std::string>, std::int64_t> at; // in the present pass
      int pass = 1;
      std::int64_t step = 1;
      bool overlaps = false; // stages that begin before the one before them ends
      const auto check = [&]
      {
        for (int level = 0; level < 3; ++level)
        {
          const std::vector<std::string>& stages = pass == 1 ? first : later;
          const bool isFinestFirst = pass == 1 && level == 0;
          for (std::size_t s = pass == 1 && !isFinestFirst ? 2 : 1; s < stages.size(); ++s)
          {
            const std::int64_t before = at[{ level, stages[s - 1] }];
            const std::int64_t after = at[{ level, stages[s] }];
            EXPECT_LE(after, before) << pass << ' ' << level << ' ' << stages[s];
            overlaps = overlaps || (after > 0 && after < before);
          }
        }
      };
      for (const Entry& e : traced.entries)
      {
        if (std::pair(e.pass, e.step) != std::pair(pass, step))
        {
          check();
          at = e.pass == pass ? at : decltype(at){};
          std::tie(pass, step) = std::pair(e.pass, e.step);
        }
        // With several threads a stage of its own closes the rows.
        at[{ e.level, e.stage == "close rows" ? first.front() : e.stage }] = e.end;
      }
      check();
      EXPECT_TRUE(overlaps);
    });
}

TEST(Trace, StagesWorkOnWhatIsInMemory)
{
  forTracedSolves(
    [](const TracedSolve& traced)
    {
      // By level: what was in memory after the step before, and after this one.
      std::map<int, std::pair<std::int64_t, std::int64_t>> before, now;
      int pass = 0;
      for (std::size_t begin = 0, end = 0; begin < traced.entries.size(); begin = end)
      {
        const Entry& head = traced.entries[begin];
        before = head.pass == pass ? now : decltype(now){};
        now = before;
        pass = head.pass;
        for (end = begin; end < traced.entries.size() && traced.entries[end].pass == head.pass &&
                          traced.entries[end].step == head.step;
             ++end)
        {
          const Entry& e = traced.entries[end];
          if (e.stage == "in memory")
          {
            EXPECT_LE(e.first, e.end);
            EXPECT_GE(e.first, before[e.level].first); // windows move forward
            EXPECT_GE(e.end, before[e.level].second);
            now[e.level] = { e.first, e.end };
          }
        }
        for (std::size_t k = begin; k < end; ++k)
        {
          const Entry& e = traced.entries[k];
          const int level = countedLevel(e.level, e.stage);
          // Rows of P^T A P are rows of the level when they are sparsified.
          if (e.stage != "in memory" && e.stage != "P^T A P" && now.contains(level))
          {
            EXPECT_GE(e.first, before[level].first) << e.stage;
            EXPECT_LE(e.end, now[level].second) << e.stage;
          }
        }
      }
    });
}

TEST(Trace, WindowsAreSmallOutOfCoreAndEmptyAtTheEnd)
{
  const StreamMesh mesh = toStream(shuffled(torus(400, 60, 0.4)));
  for (const int threads : { 1, 4 })
  {
    const TracedSolve traced =
      solveTraced(mesh, heldEnds(mesh, 1, Weights::Cotangent), manner(threads, 300, false));
    std::map<int, Entry> last; // of the finest level, by pass
    std::int64_t widest = 0;
    bool isApart = false;
    for (const Entry& e : traced.entries)
    {
      isApart = isApart || e.stage == "weigh cells";
      if (e.stage == "in memory" && e.level == 0)
      {
        last.insert_or_assign(e.pass, e);
        widest = std::max(widest, e.pass > 1 ? e.end - e.first : 0);
      }
    }
    EXPECT_EQ(isApart, threads > 1);
    EXPECT_LT(widest, mesh.vertices() / 2);
    EXPECT_EQ(static_cast<int>(last.size()), traced.solved.report.passes);
    for (const auto& [pass, e] : last)
    {
      EXPECT_EQ(e.first, mesh.vertices()) << pass;
      EXPECT_EQ(e.end, mesh.vertices()) << pass;
    }
  }
}

TEST(Trace, WhatItThrowsEndsTheSolve)
{
  struct Enough
  {
  };
  const StreamMesh mesh = toStream(shuffled(torus(110, 60, 0.4)));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  for (const int pass : { 1, 3 })
  {
    SolveOptions options = manner(4, 300, false);
    options.trace = [pass](const TraceEntry& e)
    {
      if (e.pass == pass && e.step == 3)
      {
        throw Enough();
      }
    };
    EXPECT_THROW(solveMesh(mesh, problem, options), Enough);
  }
}

TEST(Trace, ChangesNothing)
{
  const StreamMesh mesh = toStream(shuffled(torus(110, 60, 0.4)));
  ArrayProblem problem = heldEnds(mesh, 1, Weights::Cotangent);
  for (const int threads : { 1, 4 })
  {
    const SolveOptions options = manner(threads, 300, false);
    const Solved plain = solveMesh(mesh, problem, options, 500);
    const TracedSolve traced = solveTraced(mesh, problem, options);
    EXPECT_TRUE(sameBits(plain.values, traced.solved.values));
    EXPECT_EQ(plain.report.passes, traced.solved.report.passes);
    EXPECT_FALSE(traced.entries.empty());
  }
}

} // namespace smg::testing
